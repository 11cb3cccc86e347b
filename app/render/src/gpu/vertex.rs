// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Records of vertex buffers, stated once for Rust, for WGSL and for the pipelines.

/// Declares a `repr(C)` struct whose fields are read at vertex locations from `first` on, with its WGSL declaration.
macro_rules! vertex_struct {
    (
        $(#[$meta:meta])*
        $vis:vis struct $name:ident from $first:literal {
            $($(#[$field_meta:meta])* $field_vis:vis $field:ident: $ty:ty = $format:ident,)*
        }
    ) => {
        $(#[$meta])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
        $vis struct $name {
            $($(#[$field_meta])* $field_vis $field: $ty,)*
        }

        impl $name {
            /// Attributes of the fields for pipelines.
            $vis const ATTRIBUTES: &'static [wgpu::VertexAttribute] = &{
                let mut location = $first;
                [$({
                    location += 1;
                    wgpu::VertexAttribute {
                        format: wgpu::VertexFormat::$format,
                        offset: std::mem::offset_of!($name, $field) as u64,
                        shader_location: location - 1,
                    }
                },)*]
            };

            /// Layout of a buffer of these.
            $vis const fn layout(step_mode: wgpu::VertexStepMode) -> wgpu::VertexBufferLayout<'static> {
                wgpu::VertexBufferLayout {
                    array_stride: size_of::<$name>() as u64,
                    step_mode,
                    attributes: Self::ATTRIBUTES,
                }
            }

            /// The struct as the input of a vertex shader.
            $vis fn declaration() -> String {
                $crate::gpu::vertex::declaration(stringify!($name), &[$(stringify!($field)),*], Self::ATTRIBUTES)
            }
        }
    };
}
pub(crate) use vertex_struct;

/// WGSL of a struct of vertex inputs.
pub(crate) fn declaration(name: &str, fields: &[&str], attributes: &[wgpu::VertexAttribute]) -> String {
    let field = |(field, attribute): (&&str, &wgpu::VertexAttribute)| {
        format!("    @location({}) {field}: {},\n", attribute.shader_location, wgsl_type(attribute.format))
    };
    let fields: String = fields.iter().zip(attributes).map(field).collect();
    format!("struct {name} {{\n{fields}}}\n")
}

/// Type of an attribute in WGSL.
///
/// # Panics
/// For formats that no record has.
fn wgsl_type(format: wgpu::VertexFormat) -> &'static str {
    use wgpu::VertexFormat as Format;
    match format {
        Format::Float32 => "f32",
        Format::Float32x2 => "vec2<f32>",
        Format::Float32x3 => "vec3<f32>",
        Format::Snorm16x4 | Format::Unorm8x4 => "vec4<f32>",
        Format::Uint32 => "u32",
        Format::Uint32x4 => "vec4<u32>",
        other => panic!("no vertex record has {other:?}"),
    }
}
