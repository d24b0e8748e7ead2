//! Which number stands for which direction in the labels of other tools.

use crate::error::{Error, ErrorKind, Place, Result};
use std::fmt;
use std::str::FromStr;

/// Six numbers in a row, from its first on, and the directions that they stand for.
///
/// It is written as the directions, after the first number and a colon where that is not 0:
///
/// ```
/// use polycube::mesh::LabelOrder;
///
/// let order: LabelOrder = "1:-X+X-Y+Y-Z+Z".parse()?;
/// assert_eq!(order.apply(&[1, 2, 6, -1])?, [1, 0, 4, -1]);
/// assert_eq!(order.to_string(), "1:-X+X-Y+Y-Z+Z");
/// # Ok::<(), polycube::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LabelOrder {
    /// The number of the first direction.
    first: i8,
    /// The label, 0 to 5, of each direction.
    labels: [i8; 6],
}

impl Default for LabelOrder {
    /// The order of this program and of many label files: 0 to 5 for +X −X +Y −Y +Z −Z.
    fn default() -> Self {
        Self { first: 0, labels: [0, 1, 2, 3, 4, 5] }
    }
}

impl LabelOrder {
    /// The order in which the numbers from `first` on stand for `labels`, each of 0 to 5 once.
    pub(crate) fn new(first: i8, labels: [i8; 6]) -> Self {
        debug_assert!((0..6).all(|label| labels.contains(&label)), "{labels:?} is no order");
        Self { first, labels }
    }

    /// The label, 0 to 5, that `number` stands for; −1, for none, stays.
    pub fn label(&self, number: i8) -> Option<i8> {
        let place = usize::try_from(number.checked_sub(self.first)?).ok();
        match place.and_then(|place| self.labels.get(place)) {
            None if number == -1 => Some(-1),
            found => found.copied(),
        }
    }

    /// The labels, 0 to 5 or −1, that `numbers` stand for.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] naming the face whose number stands for nothing.
    pub fn apply(&self, numbers: &[i8]) -> Result<Vec<i8>> {
        let label = |(face, &number): (u32, &i8)| {
            self.label(number).ok_or_else(|| {
                let (first, last) = (self.first, self.first + 5);
                Error::new(ErrorKind::Option, format!("{number} is no label in the order {self}"))
                    .at(Place::Face(face))
                    .remedy(format!("labels go from {first} to {last} there; -1 is for none"))
            })
        };
        (0..).zip(numbers).map(label).collect()
    }
}

/// How the directions are written, by their labels.
const NAMES: [&str; 6] = ["+X", "-X", "+Y", "-Y", "+Z", "-Z"];

impl fmt::Display for LabelOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.first != 0 {
            write!(f, "{}:", self.first)?;
        }
        self.labels.iter().try_for_each(|&label| f.write_str(NAMES[label as usize]))
    }
}

impl FromStr for LabelOrder {
    type Err = Error;

    /// Reads what [`Display`](fmt::Display) writes, with spaces and commas between the directions or without.
    fn from_str(text: &str) -> Result<Self> {
        let order = match text.split_once(':') {
            Some((first, order)) => {
                first.trim().parse().ok().filter(|first| (0..=100).contains(first)).zip(labels(order))
            }
            None => Some(0).zip(labels(text)),
        };
        order.map(|(first, labels)| Self { first, labels }).ok_or_else(|| {
            Error::new(ErrorKind::Option, format!("\"{}\" is no order of labels", text.escape_debug())).remedy(
                "name all six directions in the order of their numbers, as in \"-X+X-Y+Y-Z+Z\", after the first number \
                 and a colon where that is not 0, as in \"1:+X-X+Y-Y+Z-Z\"",
            )
        })
    }
}

fn labels(order: &str) -> Option<[i8; 6]> {
    let text: String = order.to_uppercase().chars().filter(|c| !c.is_whitespace() && *c != ',').collect();
    let words: Vec<&str> = (0..6).map(|i| text.get(2 * i..2 * i + 2)).collect::<Option<_>>()?;
    let found: Vec<i8> =
        words.iter().map(|w| NAMES.iter().position(|n| n == w).map(|i| i as i8)).collect::<Option<_>>()?;
    let found = <[i8; 6]>::try_from(found).ok()?;
    (text.len() == 12 && (0..6).all(|label| found.contains(&label))).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_are_read_as_they_are_written_and_with_spaces_and_commas() {
        for text in ["+X-X+Y-Y+Z-Z", "-Z+X-X+Y-Y+Z", "1:-X+X-Y+Y-Z+Z"] {
            assert_eq!(text.parse::<LabelOrder>().unwrap().to_string(), text);
        }
        assert_eq!("+x, -x, +y, -y, +z, -z".parse(), Ok(LabelOrder::default()));
        for wrong in ["", "+X-X+Y-Y+Z", "+X-X+Y-Y+Z+Z", "+X-X+Y-Y+Z-Z-Z", "x:+X-X+Y-Y+Z-Z", "-1:+X-X+Y-Y+Z-Z", "ä…"]
        {
            let error = wrong.parse::<LabelOrder>().unwrap_err();
            assert!(error.kind == ErrorKind::Option && !error.remedy.is_empty(), "{wrong}");
        }
    }

    #[test]
    fn a_number_that_stands_for_nothing_is_named_by_its_face() {
        let order: LabelOrder = "1:+X-X+Y-Y+Z-Z".parse().unwrap();
        assert_eq!(order.apply(&[6, -1, 1]).unwrap(), [5, -1, 0]);
        assert_eq!(order.apply(&[1, 0]).unwrap_err().place, Some(Place::Face(1)));
        assert_eq!(LabelOrder::default().apply(&[6]).unwrap_err().place, Some(Place::Face(0)));
    }
}
