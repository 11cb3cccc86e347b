// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaf shapes, veins, colours and texture atlases.
//!
//! A [`LeafMaker`] makes leaves of one kind, after photos or after nothing but the kind's name. [`Photo::extract`] turns
//! a photo into an example: blade, veins and colour (`extract`); without photos, examples are painted from pigments
//! (`paint`, [`season`]). Each new leaf has an outline of its own (`contour`, [`OutlineModel`]), veins grown inside it
//! ([`growth`]) and a texture synthesised from the examples along its veins (`synthesis`, [`Painter`]). It leaves as
//! [`LeafMaps`] (colour, relief, translucency), as meshes that curl as leaves dry ([`form`]) and as numbers
//! ([`LeafFacts`]), and is kept in a [`LeafFolder`]. [`Comparison`] measures made leaves against photographed ones. A
//! [`Layer`] is one leaf as a renderer wants it, an [`Atlas`] the leaves of all kinds; [`LightBody`] paints feathers,
//! paper, plates and samaras.
//!
//! # Units
//! Blades and veins are in pixels of their picture, y down. Drawn outlines are in leaf coordinates first: the blade meets
//! its petiole at (0, -1), its tip lies near (0, 1), y up. Colours are linear sRGB until the last step. Seasons run
//! from 0 (green) to 1 (brown).

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod atlas;
mod blade;
mod bleed;
mod burn;
mod compare;
mod contour;
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
mod leaf_pack;
mod light_body;
mod making;
mod maps;
mod math;
mod mipmap;
mod noise;
mod outline_model;
mod paint;
mod plane;
mod planform;
mod raster;
mod regular_file;
mod rng;
pub mod season;
mod shape;
mod specimen;
mod spline;
mod synthesis;
mod vein_graph;

pub use atlas::Atlas;
pub use blade::{Blade, Mask};
pub use burn::BurnMap;
pub use compare::{
    ComparedLeaf, Comparison, Distances, Levels, Measured, Metric, Variety, leaf_pictures,
    sheet as comparison_sheet,
};
pub use contour::DrawnLeaf;
pub use error::TexgenError;
pub use extract::{Extraction, Overlay, Photo};
pub use folder::{
    BodyFacts, FOLDER_VERSION, FolderError, FolderLeaf, FormLevel, FormShape, LeafFacts, LeafFolder,
    LeafForm, MANIFEST_NAME, Manifest, PetioleFacts,
};
pub use layer::Layer;
pub use leaf_pack::{LeafPack, PACK_SIZE_PX, PackError};
pub use light_body::LightBody;
pub use making::{Assortment, Build, LeafMaker, MadeLeaf, MakeOptions, RECIPE};
pub use maps::LeafMaps;
pub use outline_model::OutlineModel;
pub use shape::Shape;
pub use specimen::Specimen;
pub use synthesis::{Painted, Painter, Stage};
pub use vein_graph::{VeinGraph, VeinGrower, VeinNode};
