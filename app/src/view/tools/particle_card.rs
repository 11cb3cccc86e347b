// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! The card of a single particle.

use windfall_core::device::particle::nest::nest_place;
use windfall_core::device::particle::record::{
    PARTICLE_ALIVE, PARTICLE_DORMANT, PARTICLE_GROUNDED, PARTICLE_RESTING, PARTICLE_SIZE_ONE, particle_hits,
    particle_life, particle_population, particle_size, particle_state,
};
use windfall_core::device::wind::sample::wind_at;
use windfall_core::scene::{Meets, ParticleEvent, Particles};
use windfall_core::{Clock, CompiledScene};

use crate::run::digits::grouped;
use crate::view::tools::card::{Card, length};
use crate::view::tools::pick::is_there;
use crate::view::tools::probe::ParticleRecords;

/// The card of a particle in `slot`, as it is at `clock`.
pub(crate) fn particle_card(
    compiled: &CompiledScene,
    clock: &Clock,
    slot: u32,
    records: &ParticleRecords,
) -> Card {
    let ParticleRecords { place, motion, traits } = *records;
    let number = particle_population(place.bits) as usize;
    let (Some(population), Some(block)) =
        (compiled.scene().particles.get(number), compiled.block().populations.get(number))
    else {
        return Card::default();
    };
    let own_place = slot.wrapping_sub(block.first_slot);
    let mut rows = vec![("particle", format!("{}, slot {}", grouped(traits.id), grouped(own_place)))];
    rows.push(("state", doing(place.bits)));
    if particle_state(place.bits) == PARTICLE_DORMANT {
        return Card { title: population.name.clone(), rows };
    }
    if is_there(place.bits) {
        let velocity = motion.velocity.into();
        let level = motion.velocity[0].hypot(motion.velocity[2]);
        rows.push(("speed", format!("{:.2} m/s, {level:.2} level", length(velocity))));
        let [x, y, z] = place.position;
        rows.push(("height", format!("{:.2} m above the ground", y - compiled.ground_height(x, z))));
        let age = f64::from(clock.step().wrapping_sub(motion.birth).cast_signed());
        rows.push(("age", format!("{:.2} s since its birth", age * f64::from(clock.dt_s()))));
    }
    let life = particle_life(traits.life_size);
    rows.push((
        "life",
        match life {
            0 => "age does not end it".to_owned(),
            steps => format!("{:.2} s", f64::from(steps) * f64::from(clock.dt_s())),
        },
    ));
    if let Some(nest) = &population.nest {
        let parent = nest_place(&block.nest, own_place).parent;
        rows.push(("parent", format!("{}, slot {}: {}", nest.of, grouped(parent), born(nest.on))));
    }
    let hits = particle_hits(place.bits);
    rows.push(("hits", format!("{}, {}", grouped(hits), meets(population))));
    let ratio = particle_size(traits.life_size) as f32 / PARTICLE_SIZE_ONE as f32;
    let size_mm = 1000.0 * ratio * population.size_m.mean();
    rows.push(("size", format!("{size_mm:.1} mm, {ratio:.2} of the mean")));
    if is_there(place.bits) {
        let step = compiled.step_block(clock);
        let wind = wind_at(&compiled.context(&step), place.position.into());
        rows.push(("wind", format!("{:.2} m/s around it", length(wind))));
    }
    Card { title: population.name.clone(), rows }
}

/// The state of a particle in words.
fn doing(bits: u32) -> String {
    let text = match particle_state(bits) {
        PARTICLE_DORMANT => "not born yet",
        PARTICLE_ALIVE => "moves",
        PARTICLE_RESTING if bits & PARTICLE_GROUNDED != 0 => "rests on the ground",
        PARTICLE_RESTING => "rests on something",
        _ => "dead",
    };
    text.to_owned()
}

/// The event of its parent at which a particle was born, in words.
fn born(event: ParticleEvent) -> String {
    match event {
        ParticleEvent::Birth => "its birth".to_owned(),
        ParticleEvent::Death => "its death".to_owned(),
        ParticleEvent::Hit => "a hit of it".to_owned(),
        ParticleEvent::Every { steps } => format!("every {} steps", grouped(steps)),
    }
}

/// The answer of a population to what is in the way.
fn meets(population: &Particles) -> &'static str {
    match population.meets {
        Meets::Nothing => "passes through things",
        Meets::Die => "the first ends it",
        Meets::Stick => "it stays where it hits",
        Meets::Bounce { .. } => "it bounces",
    }
}

#[cfg(test)]
mod tests {
    use windfall_core::device::particle::record::{PARTICLE_DEAD, particle_bits};
    use windfall_core::{Scene, World};

    use super::*;

    /// Sparks that fall to the ground and splash into drops.
    const SCENE: &str = "(particles: [
        (name: \"spark\", count: 300, from: Sphere(center_m: (0.0, 0.5, 0.0), radius_m: 0.1), release: Rate(per_s: 100.0, from_s: 0.0),
         life_s: Some(Constant(2.0)), meets: Bounce(restitution: 0.3, friction: Coulomb(0.3))),
        (name: \"drop\", count: 1200, nest: Some((of: \"spark\", on: Hit, fan: 2)), life_s: Some(Constant(0.4))),
    ])";

    fn row(card: &Card, name: &str) -> Option<String> {
        card.rows.iter().find(|(row, _)| *row == name).map(|(_, text)| text.clone())
    }

    fn world() -> World {
        let mut world = World::build(&Scene::from_ron(SCENE, "sparks").expect("RON")).expect("valid");
        windfall_core::oracle::step(&mut world, 90);
        world
    }

    fn card_of(world: &World, slot: usize) -> Card {
        let number = u32::try_from(slot).expect("few");
        let records = ParticleRecords::of(&world.particles, slot);
        particle_card(&world.compiled, &world.clock, number, &records)
    }

    #[test]
    fn the_card_says_what_a_particle_is_and_does() {
        let world = world();
        let alive = |slots: std::ops::Range<usize>| {
            slots.filter(|&slot| is_there(world.particles.place[slot].bits)).collect::<Vec<_>>()
        };
        let (sparks, drops) = (alive(0..300), alive(300..1500));
        assert!(sparks.len() > 50 && !drops.is_empty(), "{} and {} live", sparks.len(), drops.len());
        for slot in sparks {
            let card = card_of(&world, slot);
            assert_eq!(card.title, "spark", "its population");
            let age = f64::from(world.clock.step() - world.particles.motion[slot].birth) / 60.0;
            assert_eq!(row(&card, "age"), Some(format!("{age:.2} s since its birth")), "{card:?}");
            assert_eq!(row(&card, "life").as_deref(), Some("2.00 s"), "{card:?}");
            assert_eq!(row(&card, "parent"), None, "sparks have none");
            let hits = particle_hits(world.particles.place[slot].bits);
            assert_eq!(row(&card, "hits"), Some(format!("{hits}, it bounces")), "{card:?}");
            let [x, y, z] = world.particles.motion[slot].velocity;
            let speed = row(&card, "speed").expect("a speed");
            assert!(speed.starts_with(&format!("{:.2} m/s", (x * x + y * y + z * z).sqrt())), "{speed}");
        }
        for slot in drops {
            let card = card_of(&world, slot);
            let parent = (slot - 300) / 4;
            assert_eq!(row(&card, "parent"), Some(format!("spark, slot {parent}: a hit of it")), "{card:?}");
            assert_eq!(row(&card, "state").as_deref(), Some("moves"), "{card:?}");
        }
    }

    #[test]
    fn what_is_not_there_goes_nowhere() {
        let mut world = world();
        let states = [(PARTICLE_DORMANT, "not born yet"), (PARTICLE_DEAD, "dead")];
        for (state, words) in states {
            world.particles.place[0].bits = particle_bits(state, 0);
            let card = card_of(&world, 0);
            assert_eq!(
                (row(&card, "state").as_deref(), row(&card, "speed")),
                (Some(words), None),
                "{card:?}"
            );
        }
        world.particles.place[0].bits = particle_bits(PARTICLE_RESTING, 0) | PARTICLE_GROUNDED;
        assert_eq!(row(&card_of(&world, 0), "state").as_deref(), Some("rests on the ground"), "it lies");
    }
}
