// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Structs and constants that Rust and WGSL share, stated once.
//!
//! [`shared_struct!`](crate::shared_struct) makes a plain-old-data struct together with its WGSL text, and
//! [`shared_constants!`](crate::shared_constants) constants together with theirs; the shader prelude is generated
//! from both.

use bytemuck::{Pod, Zeroable};

/// A type that has the same bytes in Rust and in WGSL.
pub trait Wgsl: Pod {
    /// Name of the type in WGSL.
    fn name() -> String;
}

/// A shared struct with its fields, for the generated prelude and for layout checks.
pub trait WgslStruct: Wgsl {
    /// Name, WGSL type and byte offset of every field, in order.
    fn fields() -> Vec<(&'static str, String, usize)>;

    /// The struct's declaration in WGSL.
    fn declaration() -> String {
        let fields: String =
            Self::fields().iter().map(|(name, ty, _)| format!("    {name}: {ty},\n")).collect();
        format!("struct {} {{\n{fields}}}\n", Self::name())
    }
}

/// `vec4<f32>`, a row of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Float4(pub [f32; 4]);

/// `vec4<u32>`, a row of a table or four words of a list in a uniform block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C, align(16))]
pub struct Uint4(pub [u32; 4]);

/// A type of which uniform blocks hold arrays: its size is a multiple of 16 bytes.
pub trait WgslElement: Wgsl {}

macro_rules! wgsl_names {
    ($($ty:ty: $name:literal,)*) => {
        $(impl Wgsl for $ty {
            fn name() -> String {
                $name.into()
            }
        })*
    };
}

wgsl_names! {
    u32: "u32",
    i32: "i32",
    f32: "f32",
    Float4: "vec4<f32>",
    Uint4: "vec4<u32>",
    [u32; 2]: "vec2<u32>",
    [u32; 3]: "vec3<u32>",
    [u32; 4]: "vec4<u32>",
    [i32; 3]: "vec3<i32>",
    [f32; 3]: "vec3<f32>",
    [f32; 4]: "vec4<f32>",
    [f32; 2]: "vec2<f32>",
    [i32; 2]: "vec2<i32>",
    [[f32; 4]; 4]: "mat4x4<f32>",
}

impl WgslElement for Float4 {}
impl WgslElement for Uint4 {}
impl WgslElement for [[f32; 4]; 4] {}

impl<T: WgslElement, const N: usize> Wgsl for [T; N] {
    fn name() -> String {
        format!("array<{}, {N}>", T::name())
    }
}

/// A constant's value, written so that WGSL reads back the same bits.
pub trait WgslConstant {
    /// The literal in WGSL.
    fn literal(self) -> String;
}

impl WgslConstant for u32 {
    fn literal(self) -> String {
        format!("{self}u")
    }
}

impl WgslConstant for f32 {
    fn literal(self) -> String {
        format!("{self:?}f")
    }
}

impl WgslConstant for [f32; 3] {
    fn literal(self) -> String {
        format!("vec3({})", self.map(f32::literal).join(", "))
    }
}

/// Declares a `repr(C)` struct of [`Wgsl`](crate::layout::Wgsl) fields that is plain old data and knows its WGSL
/// declaration. An array of three numbers is a vector in WGSL, which starts at a multiple of 16 bytes: a scalar follows
/// it. `padding` fills the struct up to a multiple of 16 bytes, as WGSL does by itself.
#[macro_export]
macro_rules! shared_struct {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident $(, padding $padding:literal)? {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $ty:ty,)*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        #[repr(C, align(16))]
        $vis struct $name {
            $($(#[$field_meta])* $field_vis $field: $ty,)*
            $(
                /// Zeros up to a multiple of 16 bytes.
                $vis padding: [u8; $padding],
            )?
        }

        impl $crate::layout::Wgsl for $name {
            fn name() -> String {
                stringify!($name).into()
            }
        }

        impl $crate::layout::WgslElement for $name {}

        impl $crate::layout::WgslStruct for $name {
            fn fields() -> Vec<(&'static str, String, usize)> {
                vec![$((
                    stringify!($field),
                    <$ty as $crate::layout::Wgsl>::name(),
                    core::mem::offset_of!($name, $field),
                ),)*]
            }
        }
    };
}

/// Declares a struct as [`shared_struct!`](crate::shared_struct) does that is also the [`Record`](crate::store::Record) of a
/// column.
#[macro_export]
macro_rules! shared_record {
    (
        $(#[$meta:meta])*
        pub struct $name:ident { $($(#[$field_meta:meta])* pub $field:ident: $ty:ty,)* }
    ) => {
        $crate::shared_struct! {
            $(#[$meta])*
            #[derive(Default)]
            pub struct $name { $($(#[$field_meta])* pub $field: $ty,)* }
        }

        impl $crate::store::Record for $name {
            const NAME: &'static str = stringify!($name);
            const FIELDS: &'static [$crate::store::Field] =
                &[$($crate::store::Field::of::<$ty>(stringify!($field)),)*];
        }
    };
}

/// Declares constants and a function `wgsl_constants` that lists them as WGSL declarations.
#[macro_export]
macro_rules! shared_constants {
    ($($(#[$meta:meta])* $vis:vis const $name:ident: $ty:ty = $value:expr;)*) => {
        $($(#[$meta])* $vis const $name: $ty = $value;)*

        /// Name and WGSL declaration of every shared constant of this module.
        pub fn wgsl_constants() -> Vec<(&'static str, String)> {
            vec![$((
                stringify!($name),
                format!(
                    "const {}: {} = {};\n",
                    stringify!($name),
                    <$ty as $crate::layout::Wgsl>::name(),
                    $crate::layout::WgslConstant::literal($name),
                ),
            ),)*]
        }
    };
}
