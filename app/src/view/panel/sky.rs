// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Sun, sky, haze.

use egui::Ui;
use windfall_core::scene::{PhysicalSky, Sky, SkyMap, View, limits};

use super::field::{choice, field};
use super::words::text;

pub(super) fn show(ui: &mut Ui, view: &mut View, own: &View) {
    let (sun, haze) = (&mut view.sun, &mut view.haze);
    let tip = "Where the sun is seen, from +x turning to +z";
    field("Sun azimuth", tip, limits::AZIMUTH_DEG).show(ui, &mut sun.azimuth_deg, own.sun.azimuth_deg);
    let tip = "Height of the sun above the horizon; below it, it lights the sky alone";
    field("Sun height", tip, limits::ELEVATION_DEG).show(ui, &mut sun.elevation_deg, own.sun.elevation_deg);
    let path = if let Sky::Map(own) = &own.sky { own.path.clone() } else { "sky.hdr".into() };
    let options =
        [("physical", Sky::Physical(PhysicalSky::default())), ("picture", Sky::Map(SkyMap::new(path)))];
    let tip =
        "Computed from the air and the sun, or a picture of high dynamic range (drop one on the window)";
    choice(ui, "Sky", tip, &mut view.sky, Some(&own.sky), &options);
    match (&mut view.sky, &own.sky) {
        (Sky::Physical(air), own) => {
            physical(ui, air, if let Sky::Physical(own) = own { Some(own) } else { None })
        }
        (Sky::Map(map), own) => picture(ui, map, if let Sky::Map(own) = own { Some(own) } else { None }),
    }
    let tip = "Meteorological visibility: where black things fade to a contrast of 2 %";
    let visibility = field("Visibility", tip, limits::VISIBILITY_M).fine(20.0);
    visibility.show(ui, &mut haze.visibility_m, own.haze.visibility_m);
    let tip = "Height at which the haze has thinned to a third";
    field("Haze depth", tip, limits::HAZE_DEPTH_M).fine(1.0).show(ui, &mut haze.depth_m, own.haze.depth_m);
}

fn physical(ui: &mut Ui, air: &mut PhysicalSky, own: Option<&PhysicalSky>) {
    let tip = "Optical depth of the aerosol: 0.05 is very clear air, 0.1 clear, 0.4 hazy";
    field("Aerosol", tip, limits::AEROSOL).show(ui, &mut air.aerosol, own.map(|own| own.aerosol));
    let tip = "Share of the sky that clouds cover: 0.2 is fair, 1 overcast without any direct sun";
    field("Clouds", tip, limits::CLOUD_COVER).show(ui, &mut air.cloud_cover, own.map(|own| own.cloud_cover));
}

fn picture(ui: &mut Ui, map: &mut SkyMap, own: Option<&SkyMap>) {
    let tip = "A Radiance (.hdr) or OpenEXR (.exr) file: latitude and longitude 2:1, or a cube as a cross";
    text(ui, "Sky file", tip, &mut map.path, own.map(|own| &*own.path), 1);
    let tip = "Turn about the vertical, from +x to +z";
    let turn = field("Sky turn", tip, limits::ROTATION_DEG);
    turn.show(ui, &mut map.rotation_deg, own.map(|own| own.rotation_deg));
    let tip = "Luminance of the picture's value 1; pictures are rarely calibrated";
    let intensity = field("Brightness", tip, limits::INTENSITY_KCD_M2).fine(0.001);
    intensity.show(ui, &mut map.intensity_kcd_m2, own.map(|own| own.intensity_kcd_m2));
}
