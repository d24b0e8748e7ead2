//! Labels: which of the six axis directions a boundary face looks at.

use crate::mesh::{Face, Point};
use nalgebra::Vector3;

/// One of +X −X +Y −Y +Z −Z, numbered 0 to 5 as in the label files of this field.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, bitcode::Encode, bitcode::Decode,
)]
#[serde(transparent)]
pub struct Label(u8);

impl Label {
    /// The label numbered `index`, if that is one of 0 to 5.
    pub fn new(index: i8) -> Option<Self> {
        (0..6).contains(&index).then_some(Self(index as u8))
    }

    /// The label that looks along `axis` (0, 1 or 2), upwards or downwards.
    pub(crate) fn facing(axis: usize, upwards: bool) -> Self {
        debug_assert!(axis < 3, "there is no axis {axis}");
        Self((2 * axis) as u8 + u8::from(!upwards))
    }

    /// The label whose direction is closest to `normal`, and the cosine of the angle between them.
    /// Of several equally close ones the first in the order of the labels.
    pub fn nearest(normal: &Vector3<f64>) -> (Self, f64) {
        let axis = normal.iamax();
        let label = Self((2 * axis) as u8 + u8::from(normal[axis] < 0.0));
        (label, normal[axis].abs() / normal.norm())
    }

    /// 0 to 5.
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// 0, 1 or 2 for X, Y or Z.
    pub fn axis(self) -> usize {
        self.index() / 2
    }

    /// +1 or −1 along [`axis`](Self::axis).
    pub fn sign(self) -> i8 {
        if self.0.is_multiple_of(2) { 1 } else { -1 }
    }

    /// Whether left is up (+1) or down (−1) its axis, seen from outside when walking up `axis` on a face of this label.
    pub(crate) fn left(self, axis: usize) -> i8 {
        // Left is `normal × direction`.
        if (self.axis() + 1) % 3 == axis { self.sign() } else { -self.sign() }
    }

    /// The label that looks the other way.
    #[must_use]
    pub fn opposite(self) -> Self {
        Self(self.0 ^ 1)
    }
}

impl std::fmt::Display for Label {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(["+X", "-X", "+Y", "-Y", "+Z", "-Z"][self.index()])
    }
}

/// Twice the area vector of a face: its length is twice the area, its direction the outward normal.
pub(crate) fn area_vector(points: &[Point], face: &Face) -> Vector3<f64> {
    let at = |v: u32| points[v as usize];
    match *face {
        Face::Triangle([a, b, c]) => (at(b) - at(a)).cross(&(at(c) - at(a))),
        Face::Quad([a, b, c, d]) => (at(c) - at(a)).cross(&(at(d) - at(b))),
    }
}

/// Six times the volume of the cone over a face from `apex`, negative where the face looks to it. Over all faces of a
/// closed surface their sum is that of what it encloses, wherever the apex is.
pub(crate) fn cone(points: &[Point], face: &Face, apex: &Point) -> f64 {
    (face.middle(points) - apex).dot(&area_vector(points, face))
}
