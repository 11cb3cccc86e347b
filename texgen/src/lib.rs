// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaf shapes, veins, colours and texture atlases.
//!
//! [`Atlas::generate`] draws leaves from a few numbers, without any photo. For each leaf it makes an outline
//! (`contour`), grows veins inside it (`veins`), ages its pigments texel by texel ([`season`]), wears it
//! down (`damage`), paints it (`paint`), carries its colour past the edge (`bleed`) and filters it down to one
//! texel (`mipmap`).
//!
//! # Units
//! Leaf coordinates: the blade meets its petiole at (0, -1), its tip lies near (0, 1), y up. Colours are linear
//! sRGB until the last step. Seasons run from 0 (green) to 1 (brown).

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod atlas;
mod blade;
mod bleed;
mod compare;
mod contour;
mod damage;
mod distance;
mod error;
mod extract;
mod field;
mod fill;
mod folder;
pub mod form;
pub mod growth;
mod lab;
mod layer;
mod light_body;
mod making;
mod maps;
mod math;
mod mipmap;
mod noise;
mod outline_model;
mod paint;
mod planform;
mod raster;
mod rng;
pub mod season;
mod shape;
mod specimen;
mod spline;
mod synthesis;
mod vein_graph;
mod veins;
mod warp;

pub use atlas::{Atlas, AtlasEntry, AtlasRequest};
pub use blade::{Blade, Mask};
pub use compare::{
    ComparedLeaf, Comparison, Distances, Levels, Measured, Metric, Variety, leaf_pictures,
    sheet as comparison_sheet,
};
pub use contour::DrawnLeaf;
pub use error::TexgenError;
pub use extract::{Extraction, Overlay, Photo};
pub use folder::{
    BodyFacts, FOLDER_VERSION, FolderError, FolderLeaf, FormLevel, FormShape, LeafFacts, LeafFolder,
    LeafForm, MANIFEST_NAME, Manifest,
};
pub use layer::Layer;
pub use light_body::LightBody;
pub use making::{Assortment, Build, LeafMaker, MadeLeaf, MakeOptions, RECIPE};
pub use maps::LeafMaps;
pub use outline_model::OutlineModel;
pub use shape::Shape;
pub use specimen::Specimen;
pub use synthesis::{Painted, Painter, Stage};
pub use vein_graph::{VeinGraph, VeinGrower, VeinNode};
