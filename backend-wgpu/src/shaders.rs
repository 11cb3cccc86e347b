// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Puts shaders together: WGSL files that import each other by name, behind the generated prelude.

use std::collections::BTreeSet;

use thiserror::Error;

use crate::exact::decorate_no_contraction;
use crate::kernel_id::KernelId;
use crate::{lists, prelude};

/// A shader that does not compile: a mistake of ours, or of an edit.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ShaderError {
    /// An import of a module that is not there.
    #[error("shader module '{0}' does not exist")]
    UnknownModule(String),
    /// WGSL that naga rejects.
    #[error("{0}")]
    Wgsl(String),
}

/// Names and texts of all shader modules.
#[derive(Clone, Debug)]
pub struct Shaders {
    modules: Vec<(&'static str, String)>,
    /// Modules as one kernel sees them.
    of_kernels: Vec<(KernelId, &'static str, String)>,
}

macro_rules! modules {
    ($($name:literal),* $(,)?) => {
        vec![$(($name, include_str!(concat!("shaders/", $name, ".wgsl")).to_string())),*]
    };
}

impl Default for Shaders {
    fn default() -> Self {
        let mut modules = modules![
            "bindings",
            "flight/body",
            "flight/contact",
            "flight/rates",
            "flight/regime",
            "flight/runge_kutta",
            "flight/strike",
            "arith/math",
            "arith/matrix",
            "arith/quaternion",
            "arith/rng",
            "arith/vector",
            "kernels/advance",
            "kernels/burn_leaves",
            "kernels/follow_leaves",
            "kernels/gather_heat",
            "kernels/settle_fires",
            "kernels/land_flakes",
            "kernels/list_active",
            "kernels/resolve_events",
            "kernels/sample_air",
            "kernels/carry",
            "kernels/carry_forces",
            "kernels/check_cover",
            "kernels/clear_collisions",
            "kernels/collide",
            "kernels/fly",
            "kernels/gather_collisions",
            "kernels/keep_history",
            "kernels/measure",
            "kernels/press_snow",
            "kernels/pull_particles",
            "kernels/push_lying",
            "kernels/stack_litter",
            "kernels/step_particles",
            "kernels/step_branch_snow",
            "kernels/step_snow",
            "kernels/wake_lying",
            "kernels/sway_coast",
            "kernels/sway_inward",
            "kernels/sway_follow",
            "kernels/sway_gather",
            "kernels/sway_outward",
            "leaf/advance",
            "leaf/afloat",
            "leaf/air",
            "leaf/air_cell",
            "leaf/at_rest",
            "leaf/burn",
            "leaf/burn_bindings",
            "leaf/carry",
            "leaf/collide",
            "leaf/cone_spiral",
            "leaf/fall",
            "leaf/fly",
            "leaf/join",
            "leaf/launch",
            "leaf/lie",
            "leaf/own",
            "leaf/carrier_bindings",
            "leaf/petiole",
            "leaf/record",
            "leaf/release",
            "leaf/settle",
            "leaf/stack",
            "leaf/strike",
            "leaf/wake",
            "lists/active",
            "lists/append_active",
            "lists/events",
            "lists/fill_active",
            "lists/fill_events",
            "lists/turns",
            "motion/feature",
            "motion/lookup",
            "particle/air",
            "particle/birth",
            "particle/bindings",
            "particle/draw",
            "particle/flake_bindings",
            "particle/fly",
            "particle/force",
            "particle/force_carrier",
            "particle/force_carrier_bindings",
            "particle/history",
            "particle/history_bindings",
            "particle/local_space",
            "particle/mutual",
            "particle/mutual_bindings",
            "particle/nest",
            "particle/on_leaf",
            "particle/on_leaf_bindings",
            "particle/record",
            "particle/step",
            "particle/strike",
            "solid/distance",
            "solid/grid",
            "solid/hull",
            "solid/near",
            "solid/shape",
            "terrain/ground",
            "terrain/litter",
            "terrain/snow",
            "terrain/snow_print",
            "tree/bindings",
            "tree/branch_fall",
            "tree/branch_snow",
            "tree/sway/body",
            "tree/sway/coast",
            "tree/sway/composite",
            "tree/sway/inward",
            "tree/sway/load",
            "tree/sway/oliapuram_kumar",
            "tree/sway/quigley",
            "tree/sway/row",
            "tree/sway/outward",
            "tree/sway/twig",
            "tree/sway/work",
            "wind/gust",
            "wind/jet",
            "wind/packed",
            "wind/pile_shadow",
            "wind/plume",
            "wind/profile",
            "wind/row",
            "wind/sample",
            "wind/shelter",
            "wind/slipstream",
            "wind/turbulence",
            "wind/vortex",
        ];
        modules.push(("prelude", prelude::structs() + &prelude::constants() + &lists::declarations()));
        // Every binding is of a prelude type.
        modules[0].1.insert_str(0, "#import prelude\n");
        Self { modules, of_kernels: Vec::new() }
    }
}

impl FromIterator<(&'static str, String)> for Shaders {
    /// Modules by name and text, which import each other and none of the simulator's.
    fn from_iter<I: IntoIterator<Item = (&'static str, String)>>(modules: I) -> Self {
        Self { modules: modules.into_iter().collect(), of_kernels: Vec::new() }
    }
}

impl Extend<(&'static str, String)> for Shaders {
    fn extend<I: IntoIterator<Item = (&'static str, String)>>(&mut self, modules: I) {
        self.modules.extend(modules);
    }
}

impl Shaders {
    /// Names of all modules.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.modules.iter().map(|module| module.0)
    }

    /// Text of a module.
    pub fn text(&self, name: &str) -> Option<&str> {
        self.modules.iter().find(|module| module.0 == name).map(|module| module.1.as_str())
    }

    /// The same shaders with `old` replaced by `new` in one module: for tests that must notice it. `None` if the
    /// module or the text is not there.
    #[must_use]
    pub fn edited(mut self, name: &str, old: &str, new: &str) -> Option<Self> {
        let module = self.modules.iter_mut().find(|module| module.0 == name)?;
        if !module.1.contains(old) {
            return None;
        }
        module.1 = module.1.replacen(old, new, 1);
        Some(self)
    }

    /// The same, but one kernel alone sees the edit, and is all that has to be compiled anew. `None` also if it does not import the module.
    #[must_use]
    pub fn edited_in(mut self, kernel: KernelId, name: &str, old: &str, new: &str) -> Option<Self> {
        let (file, mut seen) = (format!("kernels/{}", kernel.name()), BTreeSet::new());
        self.append(&file, None, &mut seen, &mut String::new()).ok()?;
        let (name, text) = self.modules.iter().find(|module| module.0 == name)?;
        if !seen.contains(name) || !text.contains(old) {
            return None;
        }
        self.of_kernels.push((kernel, name, text.replacen(old, new, 1)));
        Some(self)
    }

    /// One module with everything it imports, each once, imports first.
    ///
    /// # Errors
    /// [`ShaderError::UnknownModule`].
    pub fn compose(&self, name: &str) -> Result<String, ShaderError> {
        self.compose_for(name, None)
    }

    /// A kernel with everything it imports.
    ///
    /// # Errors
    /// [`ShaderError::UnknownModule`].
    pub fn kernel(&self, kernel: KernelId) -> Result<String, ShaderError> {
        self.compose_for(&format!("kernels/{}", kernel.name()), Some(kernel))
    }

    fn compose_for(&self, name: &str, kernel: Option<KernelId>) -> Result<String, ShaderError> {
        let mut source = String::new();
        self.append(name, kernel, &mut BTreeSet::new(), &mut source)?;
        Ok(source)
    }

    fn append<'a>(
        &'a self,
        name: &'a str,
        kernel: Option<KernelId>,
        seen: &mut BTreeSet<&'a str>,
        out: &mut String,
    ) -> Result<(), ShaderError> {
        if !seen.insert(name) {
            return Ok(());
        }
        let own = self.of_kernels.iter().find(|(of, module, _)| Some(*of) == kernel && *module == name);
        let text = own.map(|(_, _, text)| text.as_str()).or_else(|| self.text(name));
        let text = text.ok_or_else(|| ShaderError::UnknownModule(name.into()))?;
        for import in text.lines().filter_map(|line| line.strip_prefix("#import ")) {
            self.append(import.trim(), kernel, seen, out)?;
        }
        out.extend(text.lines().filter(|line| !line.starts_with("#import ")).flat_map(|line| [line, "\n"]));
        Ok(())
    }
}

/// Compiles WGSL to SPIR-V whose every float operation keeps its own rounding.
///
/// # Errors
/// [`ShaderError::Wgsl`] with naga's message.
pub(crate) fn compile_exact(source: &str) -> Result<Vec<u32>, ShaderError> {
    use naga::compact::{KeepUnused, compact};
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    let wgsl = |message: String| ShaderError::Wgsl(message);
    let mut module =
        naga::front::wgsl::parse_str(source).map_err(|error| wgsl(error.emit_to_string(source)))?;
    let validated = |module: &naga::Module| {
        Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(module)
            .map_err(|error| wgsl(error.emit_to_string(source)))
    };
    // What is valid can be compacted: drivers may work long on functions that nobody calls.
    validated(&module)?;
    compact(&mut module, KeepUnused::No);
    let info = validated(&module)?;
    let options =
        naga::back::spv::Options { lang_version: (1, 3), fake_missing_bindings: true, ..Default::default() };
    let words = naga::back::spv::write_vec(&module, &info, &options, None)
        .map_err(|error| wgsl(error.to_string()))?;
    Ok(decorate_no_contraction(&words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edit_in_one_kernel_is_seen_by_it_alone() {
        let (whole, sample, measure) = (Shaders::default(), KernelId::SampleAir, KernelId::Measure);
        let text = |shaders: &Shaders, kernel| shaders.kernel(kernel).expect("it composes");
        let edit = |kernel, name| whole.clone().edited_in(kernel, name, "fn ", "fn  ");
        let edited = edit(sample, "leaf/record").expect("it imports it");
        assert_ne!(text(&edited, sample), text(&whole, sample), "the kernel");
        assert_eq!(text(&edited, measure), text(&whole, measure), "another that imports the module");
        assert!(
            text(&whole, measure)
                .contains(whole.text("leaf/record").expect("a module").lines().last().expect("a line"))
        );
        assert!(edit(measure, "tree/sway/inward").is_none(), "a module that it does not import");
        assert!(whole.clone().edited_in(sample, "leaf/record", "no such line", "").is_none(), "a line");
    }

    #[test]
    fn functions_that_nobody_calls_are_not_compiled() {
        let kernel = "@group(0) @binding(0) var<storage, read_write> out: array<u32>;
            @compute @workgroup_size(1) fn fill() { out[0] = 7u; }\n";
        let idle = "fn idle(x: u32) -> u32 { return x * 3u + 1u; }\n";
        let alone = compile_exact(kernel).expect("it is valid");
        assert_eq!(alone, compile_exact(&(idle.to_owned() + kernel)).expect("it is valid"));
        let broken = "fn idle(x: u32) -> u32 { return x * 3.0; }\n";
        assert!(compile_exact(&(broken.to_owned() + kernel)).is_err(), "mistakes in them are still found");
    }
}
