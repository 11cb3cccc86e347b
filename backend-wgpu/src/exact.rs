// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Makes SPIR-V exact: every float operation keeps its own rounding.
//!
//! The decoration `NoContraction` forbids a driver to fuse or re-associate the operation. naga does not emit it, so it
//! is added to the finished module: for each arithmetic result one `OpDecorate`, placed with the other annotations.

/// First word of the instruction stream, behind the five header words.
const HEADER_WORDS: usize = 5;
const OP_EXT_INST: u32 = 12;
const OP_TYPE_VOID: u32 = 19;
const OP_TYPE_FORWARD_POINTER: u32 = 39;
const OP_DECORATE: u32 = 71;
const DECORATION_NO_CONTRACTION: u32 = 42;
/// Fma in the GLSL.std.450 instruction set.
const GLSL_FMA: u32 = 50;

/// Returns true if an instruction computes with floats in a way a driver might re-arrange.
fn is_float_arithmetic(opcode: u32, words: &[u32]) -> bool {
    match opcode {
        // FNegate, FAdd, FSub, FMul, FDiv, FRem, FMod.
        127 | 129 | 131 | 133 | 136 | 140 | 141 => true,
        // VectorTimesScalar to Dot.
        142..=148 => true,
        OP_EXT_INST => words.get(4) == Some(&GLSL_FMA),
        _ => false,
    }
}

/// The same module with every float operation decorated `NoContraction`.
pub fn decorate_no_contraction(module: &[u32]) -> Vec<u32> {
    let mut results = Vec::new();
    let mut annotations_end = None;
    let mut at = HEADER_WORDS;
    while at < module.len() {
        let opcode = module[at] & 0xffff;
        let length = (module[at] >> 16) as usize;
        let words = &module[at..(at + length.max(1)).min(module.len())];
        if (OP_TYPE_VOID..=OP_TYPE_FORWARD_POINTER).contains(&opcode) && annotations_end.is_none() {
            annotations_end = Some(at);
        }
        if is_float_arithmetic(opcode, words) {
            results.push(words[2]);
        }
        at += length.max(1);
    }
    let end = annotations_end.unwrap_or(module.len());
    let mut decorated = Vec::with_capacity(module.len() + 3 * results.len());
    decorated.extend_from_slice(&module[..end]);
    for result in results {
        decorated.extend([(3 << 16) | OP_DECORATE, result, DECORATION_NO_CONTRACTION]);
    }
    decorated.extend_from_slice(&module[end..]);
    decorated
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spirv(source: &str) -> Vec<u32> {
        let module = naga::front::wgsl::parse_str(source).expect("valid WGSL");
        let flags = naga::valid::ValidationFlags::all();
        let info = naga::valid::Validator::new(flags, naga::valid::Capabilities::all()).validate(&module);
        let info = info.expect("valid module");
        naga::back::spv::write_vec(&module, &info, &naga::back::spv::Options::default(), None)
            .expect("SPIR-V")
    }

    #[test]
    fn every_float_operation_is_decorated_and_nothing_else() {
        let module = spirv(
            "@group(0) @binding(0) var<storage, read_write> a: array<vec4<f32>>;
            @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
                let v = a[id.x];
                a[id.x + 1u] = (v * v + v) * 2.0 - fma(v, v, -v);
            }",
        );
        let decorated = decorate_no_contraction(&module);
        // v*v, +v, *2, -v, fma, -: six float results; the index sum is an integer.
        assert_eq!(decorated.len(), module.len() + 6 * 3, "six decorations of three words");
        let count = decorated.windows(3).filter(|w| w[0] == 0x0003_0047 && w[2] == 42).count();
        assert_eq!(count, 6, "OpDecorate %id NoContraction");
    }
}
