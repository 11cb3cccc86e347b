// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Wind speeds in words.

use windfall_core::wind::{BEAUFORT_MAX, beaufort_speed};

/// Names of the Beaufort numbers (World Meteorological Organization).
const NAMES: [&str; BEAUFORT_MAX as usize + 1] = [
    "calm",
    "light air",
    "light breeze",
    "gentle breeze",
    "moderate breeze",
    "fresh breeze",
    "strong breeze",
    "near gale",
    "gale",
    "strong gale",
    "storm",
    "violent storm",
    "hurricane",
];

/// The Beaufort number whose speed is nearest to `speed_m_s`.
pub(crate) fn beaufort_number(speed_m_s: f64) -> u8 {
    // Halfway in the number, as the official limits are.
    let limit = |number: u8| {
        let half = f64::from(number) + 0.5;
        beaufort_speed(1) * half * half.sqrt()
    };
    (0..BEAUFORT_MAX).find(|&number| speed_m_s < limit(number)).unwrap_or(BEAUFORT_MAX)
}

/// The same with its name.
pub(crate) fn beaufort_label(speed_m_s: f64) -> String {
    let number = beaufort_number(speed_m_s);
    format!("Beaufort {number}, {}", NAMES[usize::from(number)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_agree_with_the_official_limits() {
        // Lower limits in m/s.
        let limits = [0.3, 1.6, 3.4, 5.5, 8.0, 10.8, 13.9, 17.2, 20.8, 24.5, 28.5, 32.7];
        for (number, limit) in (1..).zip(limits) {
            let label = beaufort_label(limit + 0.15);
            assert!(label.starts_with(&format!("Beaufort {number},")), "{limit} m/s: {label}");
        }
        assert_eq!(beaufort_label(0.0), "Beaufort 0, calm", "none");
        assert_eq!(beaufort_label(80.0), "Beaufort 12, hurricane", "the end of the scale");
    }
}
