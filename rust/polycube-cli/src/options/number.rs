//! Numbers and their ranges, for `value_parser`.

use std::ops::RangeInclusive;

/// An angle from 0 to 45 degrees.
pub fn degrees(text: &str) -> Result<f64, String> {
    within(text, 0.0..=45.0)
}

/// A number from 0 to 1.
pub fn fraction(text: &str) -> Result<f64, String> {
    within(text, 0.0..=1.0)
}

/// A number above 0, up to 100.
pub fn percent(text: &str) -> Result<f64, String> {
    let found = positive(text).ok().filter(|x| *x <= 100.0);
    found.ok_or_else(|| "expected a number above 0, up to 100".to_owned())
}

/// Whole numbers of a range, for `value_parser`.
pub fn whole<T: TryFrom<u64>>(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| {
        let found = text.parse().ok().filter(|x| range.contains(x));
        found.and_then(|x| T::try_from(x).ok()).ok_or_else(|| {
            let (start, end) = (range.start(), range.end());
            // An end that only the machine has is told to those who went beyond it.
            if *end < MACHINE || text.parse::<f64>().is_ok_and(|x| x > *end as f64) {
                format!("expected a whole number from {start} to {end}")
            } else {
                format!("expected a whole number of {start} or more")
            }
        })
    }
}

fn within(text: &str, range: RangeInclusive<f64>) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x| range.contains(x));
    found.ok_or_else(|| format!("expected a number from {} to {}", range.start(), range.end()))
}

/// The least that a range may end at because the machine ends there.
const MACHINE: u64 = u32::MAX as u64;

/// A number of 1 or more.
pub fn at_least_one(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 1.0);
    found.ok_or_else(|| "expected a number of 1 or more".to_owned())
}

/// A number of 0 or more.
pub fn zero_or_more(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
    found.ok_or_else(|| "expected a number of 0 or more".to_owned())
}

/// A number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    let found = text.parse().ok().filter(|x: &f64| x.is_normal() && *x > 0.0);
    found.ok_or_else(|| "expected a number above 0".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_their_ranges() {
        for bad in ["0", "-1", "nan", "inf", "", "1e-320"] {
            assert!(positive(bad).is_err(), "{bad}");
        }
        for bad in ["-0.1", "1.1", "nan", "x"] {
            assert!(fraction(bad).is_err(), "{bad}");
        }
        let whole = |text| whole::<u8>(1..=16)(text);
        assert_eq!(whole("16"), Ok(16));
        for bad in ["0", "-3", "17", "300", "1.5", "x", ""] {
            assert_eq!(whole(bad), Err("expected a whole number from 1 to 16".to_owned()), "{bad}");
        }
        let counted = |text| super::whole::<u32>(1..=u64::from(u32::MAX))(text);
        assert_eq!(counted("-1"), Err("expected a whole number of 1 or more".to_owned()));
        assert!(counted("4294967296").is_err_and(|e| e.ends_with("to 4294967295")));
        assert_eq!(degrees("45"), Ok(45.0));
        assert!(degrees("45.1").is_err());
    }
}
