// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The camera of a scene and its light.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use glam::{Mat4, Vec3};
use image::Rgb;
use image::codecs::hdr::HdrEncoder;
use windfall_core::Scene;
use windfall_core::scene::{self, CameraKey, camera_at};
use windfall_render::camera::Camera;
use windfall_render::light::{Daylight, luminance};

use super::prototypes::PICTURES;
use super::samples::{Handle, Samples};
use super::text;
use crate::export::Frame;
use crate::files::WriteError;

/// Height of the picture in the camera, in tenths of a metre as the format has it: a 35 mm frame of 16:9.
const APERTURE: f32 = 0.2025;
/// Intensity of a light for each klx or kcd/m²: sunlight of 100 klx becomes about 3, so that what is white in it becomes about 1.
/// It is multiplied out, since some readers, Blender's of skies among them, ignore `inputs:exposure`.
const INTENSITY: f32 = 1.0 / 32.0;

/// Picture of the sky.
const SKY: &str = "sky.hdr";

/// The camera, if it moves.
#[derive(Debug)]
pub(super) struct ViewSamples {
    path: Vec<CameraKey>,
    handles: Option<[Handle; 2]>,
}

impl ViewSamples {
    pub(super) fn declare(samples: &mut Samples, scene: &Scene) -> Self {
        let path = scene.view.path.clone();
        let handles = (!path.is_empty()).then(|| {
            ["matrix4d xformOp:transform", "float focalLength"]
                .map(|name| samples.declare("World/Camera", name))
        });
        Self { path, handles }
    }

    pub(super) fn add(&self, samples: &mut Samples, frame: &Frame<'_>) {
        let camera = camera_at(&self.path, frame.world.clock.seconds());
        if let (Some([place, focal]), Some(camera)) = (self.handles, camera) {
            samples.add(place, frame.number, |out| text::matrix(out, pose(&camera)));
            samples.add(focal, frame.number, |out| *out += &focal_length(&camera).to_string());
        }
    }
}

/// Writes the camera and the lights.
pub(super) fn write_view(out: &mut impl Write, scene: &Scene, daylight: &Daylight) -> io::Result<()> {
    let camera = &scene.view.camera;
    let is_moving = !scene.view.path.is_empty();
    let mut place = String::new();
    text::matrix(&mut place, pose(camera));
    let (place, focal) = if is_moving {
        (String::new(), String::new())
    } else {
        (format!(" = {place}"), format!(" = {}", focal_length(camera)))
    };
    write!(
        out,
        "def Camera \"Camera\"\n{{\nfloat2 clippingRange = (0.05, 100000)\nfloat focalLength{focal}\n\
        float focusDistance = {focus}\nfloat horizontalAperture = {width}\nfloat verticalAperture = {APERTURE}\n\
        matrix4d xformOp:transform{place}\nuniform token[] xformOpOrder = [\"xformOp:transform\"]\n}}\n",
        focus = camera.eye_m.distance(camera.target_m),
        width = APERTURE * 16.0 / 9.0,
    )?;
    let color = |light: Vec3| (light / luminance(light).max(1e-9)).to_array().map(|part| part.max(0.0));
    let sun = &daylight.sun;
    if sun.direction.y > 0.0 && luminance(sun.illuminance) > 0.0 {
        // The light shines along -z.
        let turn = glam::Quat::from_rotation_arc(Vec3::Z, sun.direction);
        let mut place = String::new();
        text::matrix(&mut place, Mat4::from_quat(turn));
        let [r, g, b] = color(sun.illuminance);
        write!(
            out,
            "def DistantLight \"Sun\"\n{{\nfloat inputs:angle = 0.53\ncolor3f inputs:color = ({r}, {g}, {b})\n\
            float inputs:intensity = {}\nbool inputs:normalize = 1\n\
            matrix4d xformOp:transform = {place}\nuniform token[] xformOpOrder = [\"xformOp:transform\"]\n}}\n",
            INTENSITY * luminance(sun.illuminance)
        )?;
    }
    write!(
        out,
        "def DomeLight \"Sky\"\n{{\nfloat inputs:intensity = {INTENSITY}\n\
        asset inputs:texture:file = @./{PICTURES}/{SKY}@\ntoken inputs:texture:format = \"latlong\"\n}}\n"
    )
}

/// Writes the picture of the sky, in kcd/m²; `destination` is the folder that errors name. The format has OpenEXR's latitudes and longitudes, where the
/// middle column lies towards +z: half a turn from our own.
pub(super) fn write_sky(folder: &Path, destination: &Path, daylight: &Daylight) -> Result<(), WriteError> {
    let (width, height) = daylight.sky.size();
    let rows = daylight.sky.pixels().chunks(width).flat_map(|row| {
        let (left, right) = row.split_at(width / 2);
        right.iter().chain(left)
    });
    let pixels: Vec<_> = rows.map(|pixel| Rgb(pixel.max(Vec3::ZERO).to_array())).collect();
    let failed = WriteError::at(destination);
    let file = File::create(folder.join(PICTURES).join(SKY)).map_err(&failed)?;
    let encoded = HdrEncoder::new(BufWriter::new(file)).encode(&pixels, width, height);
    encoded.map_err(|error| failed(io::Error::other(error)))
}

/// From the camera's frame, which looks along -z with y up, to the world.
pub(in crate::export) fn pose(camera: &scene::Camera) -> Mat4 {
    let camera = Camera::from(camera);
    let back = -camera.forward();
    Mat4::from_cols(
        camera.right().extend(0.0),
        camera.up().extend(0.0),
        back.extend(0.0),
        camera.eye_m().extend(1.0),
    )
}

fn focal_length(camera: &scene::Camera) -> f32 {
    0.5 * APERTURE / (0.5 * camera.vertical_fov_deg.to_radians()).tan()
}
