// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Counter-based random numbers from an integer hash: the same everywhere, whatever the order of the leaves.

/// Mixes 64 bits (the finaliser of SplitMix64; Steele, Lea and Flood 2014).
pub(crate) fn hash64(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Uniform number in 0..1 from the upper bits of a hash.
pub(crate) fn unit_from_hash(hash: u64) -> f32 {
    (hash >> 40) as f32 / (1u64 << 24) as f32
}

/// A stream of random numbers.
#[derive(Clone, Debug)]
pub(crate) struct Rng {
    key: u64,
    count: u64,
}

impl Rng {
    /// Stream of a seed.
    pub(crate) fn new(seed: u64) -> Self {
        Self { key: hash64(seed), count: 0 }
    }

    /// Independent stream named by `label`; does not depend on what was drawn so far.
    pub(crate) fn fork(&self, label: u64) -> Self {
        Self { key: hash64(self.key ^ hash64(label.wrapping_add(0x5eed))), count: 0 }
    }

    /// Next 64 random bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.count = self.count.wrapping_add(1);
        hash64(self.key ^ self.count.wrapping_mul(0xd134_2543_de82_ef95))
    }

    /// Uniform in 0..1.
    pub(crate) fn unit(&mut self) -> f32 {
        unit_from_hash(self.bits())
    }

    /// Uniform between two numbers.
    pub(crate) fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Bell-shaped in -1..1 with standard deviation 0.41: the mean of two uniform numbers.
    pub(crate) fn bell(&mut self) -> f32 {
        self.unit() + self.unit() - 1.0
    }

    /// One of `low..=high`, evenly.
    pub(crate) fn integer(&mut self, low: u32, high: u32) -> u32 {
        let span = u64::from(high - low) + 1;
        low + u32::try_from(self.bits() % span).unwrap_or(0)
    }

    /// True with a probability.
    pub(crate) fn chance(&mut self, probability: f32) -> bool {
        self.unit() < probability
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forks_ignore_what_was_drawn() {
        let mut drawn = Rng::new(7);
        drawn.bits();
        assert_eq!(drawn.fork(3).bits(), Rng::new(7).fork(3).bits(), "fork depends on the key alone");
    }

    #[test]
    fn uniform_mean_is_one_half() {
        let mut rng = Rng::new(1);
        let mean = (0..10_000).map(|_| rng.unit()).sum::<f32>() / 10_000.0;
        assert!((mean - 0.5).abs() < 0.01, "mean of 10 000 draws is {mean}");
    }
}
