// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Leaves that are made while the window already shows the small ones that come with the program.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;
use std::time::Duration;

use rayon::ThreadPoolBuilder;
use windfall_core::Scene;
use windfall_texgen::Atlas;

use super::Viewer;
use super::editing::renderer_of;
use crate::leaves;

/// Time after which a window in which nothing moves asks again.
pub(super) const ASK_AGAIN: Duration = Duration::from_millis(200);
/// Beginning of the line that says how far the leaves are.
const SMALL_LEAVES: &str = "Small leaves for now: larger ones are being made";

/// Pictures to draw a scene with at once. Those that have to be made are planned, unless that is being done.
///
/// # Errors
/// A folder of leaves that cannot be used.
pub(super) fn pictures_at_once(making: &mut Option<LeafMaking>, scene: &Arc<Scene>) -> anyhow::Result<Atlas> {
    let (atlas, is_complete) = leaves::atlas_at_once(scene)?;
    if is_complete {
        *making = None;
    } else if making.as_ref().is_none_or(|making| making.scene.species != scene.species) {
        *making = Some(LeafMaking::of(Arc::clone(scene)));
    }
    Ok(atlas)
}

impl Viewer {
    /// Draws with the leaves that have been made, or says how far they are. A clip that is recorded keeps its leaves.
    ///
    /// # Errors
    /// A lost device.
    pub(super) fn take_made_leaves(&mut self) -> anyhow::Result<()> {
        let Some(making) = self.leaf_making.as_ref().filter(|_| self.recording.is_none()) else {
            return Ok(());
        };
        match making.take() {
            Ok(None) => {
                let text = making.message();
                let is_free =
                    self.message.as_ref().is_none_or(|(shown, _)| shown.text.starts_with(SMALL_LEAVES));
                if is_free {
                    self.say(text, false);
                }
            }
            Ok(Some(atlas)) => {
                self.leaf_making = None;
                let (format, size) = (self.screen.format(), self.renderer.size());
                let scene = Arc::clone(self.session.scene());
                self.renderer = renderer_of(
                    &self.gpu,
                    self.session.compiled(),
                    &scene,
                    &atlas,
                    format,
                    size,
                    self.quality,
                )?;
                self.set_overlays(self.instruments.overlays);
                self.has_news = true;
                self.say("The leaves are made.".into(), false);
            }
            Err(error) => {
                self.leaf_making = None;
                self.say(format!("{error:#}"), true);
            }
        }
        Ok(())
    }
}

/// Leaves of a scene to be made by a thread. Dropped, it goes on to fill the cache, and nobody takes what it makes.
pub(super) struct LeafMaking {
    scene: Arc<Scene>,
    /// Leaves of the species that is at hand: made, and all.
    progress: Arc<[AtomicU32; 2]>,
    /// None until it has begun.
    done: Option<Receiver<anyhow::Result<Atlas>>>,
}

impl LeafMaking {
    fn of(scene: Arc<Scene>) -> Self {
        Self { scene, progress: Arc::default(), done: None }
    }

    /// Begins, on half of the processors, so that the window can still be steered.
    ///
    /// # Errors
    /// A system that has no threads left.
    pub(super) fn begin(&mut self) -> anyhow::Result<()> {
        if self.done.is_some() {
            return Ok(());
        }
        let half = thread::available_parallelism().map_or(1, |count| count.get().div_ceil(2));
        let pool = ThreadPoolBuilder::new().num_threads(half).build()?;
        let (sender, done) = channel();
        let (shown, scene) = (Arc::clone(&self.progress), Arc::clone(&self.scene));
        thread::Builder::new().name("leaf making".into()).spawn(move || {
            let progress = move |made, count| {
                shown[0].store(made, Ordering::Relaxed);
                shown[1].store(count, Ordering::Relaxed);
            };
            // A window that has gone takes nothing.
            let _ = sender.send(pool.install(|| leaves::atlas_of(&scene, &progress)));
        })?;
        self.done = Some(done);
        Ok(())
    }

    /// The pictures, once they are made.
    ///
    /// # Errors
    /// Leaves that cannot be made.
    fn take(&self) -> anyhow::Result<Option<Atlas>> {
        match self.done.as_ref().map(Receiver::try_recv) {
            Some(Ok(atlas)) => atlas.map(Some),
            None | Some(Err(TryRecvError::Empty)) => Ok(None),
            Some(Err(TryRecvError::Disconnected)) => Err(anyhow::anyhow!("the leaves could not be made")),
        }
    }

    /// A line that says how far it is.
    pub(super) fn message(&self) -> String {
        let [made, count] = [0, 1].map(|at| self.progress[at].load(Ordering::Relaxed));
        if count == 0 {
            return format!("{SMALL_LEAVES}\u{2026}");
        }
        format!("{SMALL_LEAVES}, {made} of {count}\u{2026}")
    }
}

#[cfg(test)]
mod tests {
    use std::time::Instant;

    use windfall_core::scene::{LeafShape, Species};

    use super::*;

    fn begun(species: Species) -> LeafMaking {
        let mut making = LeafMaking::of(Arc::new(Scene { species: vec![species], ..Scene::default() }));
        assert!(making.take().expect("not begun").is_none(), "nothing is made before it begins");
        making.begin().expect("a thread");
        making
    }

    #[test]
    fn pictures_come_once_they_are_made() {
        // A plate is painted in no time.
        let species = Species { shape: LeafShape::Plate, ..Species::default() };
        let making = begun(species);
        let since = Instant::now();
        let atlas = loop {
            if let Some(atlas) = making.take().expect("it is painted") {
                break atlas;
            }
            assert!(since.elapsed() < Duration::from_mins(1), "it takes too long");
            thread::sleep(Duration::from_millis(5));
        };
        assert_eq!(atlas.variants as usize, atlas.layers.len(), "one species");
        assert!(making.take().is_err(), "there is no second one");
        assert!(making.message().contains("Small leaves"), "{}", making.message());
    }

    #[test]
    fn a_folder_that_is_not_there_is_an_error() {
        let species = Species { leaves: Some("/nowhere".into()), ..Species::default() };
        let making = begun(species);
        let since = Instant::now();
        let error = loop {
            match making.take() {
                Ok(None) => thread::sleep(Duration::from_millis(5)),
                Ok(Some(_)) => panic!("there is no such folder"),
                Err(error) => break error.to_string(),
            }
            assert!(since.elapsed() < Duration::from_mins(1), "it takes too long");
        };
        assert!(error.contains("/nowhere"), "{error}");
    }
}
