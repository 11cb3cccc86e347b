// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Falling leaves in a browser: the CPU backend steps a scene under the exact contract, and the renderer draws it by WebGPU.
//!
//! [`Player`] and [`Screen`] are all that the page in `page/` calls. A player needs no graphics, so it also runs in Node.

#[cfg(feature = "make")]
mod assets;
mod camera_numbers;
mod error;
mod history;
mod leaf_pictures;
mod lockstep;
mod picture;
mod player;
mod screen;
mod session;

use wasm_bindgen::prelude::wasm_bindgen;
use windfall_core::scene::{PRESETS, Scene};

#[cfg(feature = "make")]
pub use assets::thumbnail;
pub use error::WebError;
pub use player::Player;
pub use screen::Screen;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = console, js_name = error)]
    fn log_error(text: &str);
}

/// Sends what a panic says to the browser's console; the page learns of the trap by itself.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|panic| log_error(&panic.to_string())));
}

/// Version of the program whose scenes and hashes these are.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// Names and titles of the presets, in pairs.
#[wasm_bindgen]
pub fn presets() -> Vec<String> {
    let title = |name: &str| Scene::preset(name).map_or_else(|| name.to_owned(), |scene| scene.name);
    PRESETS.iter().flat_map(|&(name, _)| [name.to_owned(), title(name)]).collect()
}
