//! Elements of a mesh that go together under a name, as solvers want them.

use super::{Cells, HexFace, Mesh, Stars};
use crate::error::{Error, ErrorKind, Place, Result};
use std::collections::BTreeSet;

/// Longest name of a group, as CalculiX has it.
const LONGEST: usize = 80;

/// Room for what is put before or after a name to make it one that formats take.
const SPARE: usize = 16;

/// Elements in groups with names, each element in one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Groups {
    names: Vec<String>,
    of: Vec<u32>,
}

impl Groups {
    /// The groups `names`, of which element `i` is in number `of[i]`.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] for a name that no two groups may have in any format for solvers: it must begin with a
    /// letter, go on with letters, digits and underscores, have at most 80 characters, and differ from all others in
    /// more than upper and lower case. [`ErrorKind::Mismatch`] for an element of a group without a name.
    pub fn new(names: Vec<String>, of: Vec<u32>) -> Result<Self> {
        check_names(&names)?;
        if let Some(i) = of.iter().position(|&group| group as usize >= names.len()) {
            let message = format!("element {i} is in group {} of {}", of[i], names.len());
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give every group a name"));
        }
        Ok(Self { names, of })
    }

    /// The groups `NAME_0`, `NAME_1` and so on, of which element `i` is in number `of[i]`.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn numbered(name: &str, of: Vec<u32>) -> Result<Self> {
        let count = of.iter().max().map_or(0, |&last| u64::from(last) + 1);
        Self::new((0..count).map(|i| format!("{name}_{i}")).collect(), of)
    }

    /// The names.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The group of each element.
    pub fn of(&self) -> &[u32] {
        &self.of
    }

    /// The groups that are not empty, ascending: number, name, elements in ascending order. Linear time.
    pub fn members(&self) -> impl Iterator<Item = (usize, &str, Vec<u32>)> {
        let stars = Stars::new(self.names.len(), self.of.iter().map(|&group| [group]));
        let all = self.names.iter().enumerate().map(move |(i, name)| (i, name.as_str(), stars.of(i).to_vec()));
        all.filter(|(.., members)| !members.is_empty())
    }
}

/// Names such as [`Groups::new`] takes, made of any.
pub(super) fn plain_names(names: Vec<String>) -> Vec<String> {
    // In files of Abaqus and CalculiX this is the set of all nodes.
    let mut known = BTreeSet::from(["all_nodes".to_owned()]);
    let plain = |name: String| {
        let letters = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut plain: String = name.chars().map(letters).take(LONGEST - SPARE).collect();
        if !plain.starts_with(|c: char| c.is_ascii_alphabetic()) {
            plain.insert_str(0, "group_");
        }
        let numbered = (2..).map(|i| format!("{plain}_{i}"));
        let free = |name: &String| known.insert(name.to_ascii_lowercase());
        std::iter::once(plain.clone()).chain(numbered).find(free).unwrap_or(plain)
    };
    names.into_iter().map(plain).collect()
}

fn check_names(names: &[String]) -> Result<()> {
    let mut known = BTreeSet::new();
    for name in names {
        let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let problem = if !plain || !name.starts_with(|c: char| c.is_ascii_alphabetic()) || name.len() > LONGEST {
            "use a letter, then letters, digits and underscores, 80 in all"
        } else if !known.insert(name.to_ascii_lowercase()) {
            "give each group a name of its own, whatever the case of its letters"
        } else {
            continue;
        };
        return Err(Error::new(ErrorKind::Option, format!("a group cannot be named {name:?}")).remedy(problem));
    }
    Ok(())
}

/// A mesh of hexahedra whose blocks and whose outside are in groups.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupedHexes<'a> {
    mesh: &'a Mesh,
    blocks: Groups,
    boundary: Vec<HexFace>,
    patches: Groups,
    sides: Groups,
}

impl<'a> GroupedHexes<'a> {
    /// The hexahedra of `mesh` in `blocks`; the faces of their `boundary` in `patches`, and these in `sides`, both one
    /// for each face. Sides that are the patches are written once. O(n log n) for n hexahedra.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for other cells; [`ErrorKind::Mesh`] for none, or as [`Cells::boundary`];
    /// [`ErrorKind::Mismatch`] unless `blocks` has every hexahedron, `boundary` every face of one cell only and no
    /// other, `patches` and `sides` every face of `boundary`, and every patch lies in one side.
    pub fn new(mesh: &'a Mesh, blocks: Groups, boundary: Vec<HexFace>, patches: Groups, sides: Groups) -> Result<Self> {
        let Cells::Hexahedra(cells) = mesh.cells() else {
            let message = format!("{} have no groups", mesh.cells().kind());
            return Err(Error::new(ErrorKind::Unsupported, message).remedy("give hexahedra"));
        };
        if cells.is_empty() {
            return Err(Error::new(ErrorKind::Mesh, "a mesh without cells cannot be written"));
        }
        check_count("blocks", &blocks, cells.len())?;
        check_count("patches", &patches, boundary.len())?;
        check_count("sides", &sides, boundary.len())?;
        check_boundary(mesh.cells(), cells, &boundary)?;
        check_nested(&patches, &sides)?;
        Ok(Self { mesh, blocks, boundary, patches, sides })
    }

    /// The mesh.
    pub fn mesh(&self) -> &'a Mesh {
        self.mesh
    }

    /// The hexahedra of the mesh.
    pub fn cells(&self) -> &'a [[u32; 8]] {
        match self.mesh.cells() {
            Cells::Hexahedra(cells) => cells,
            _ => &[],
        }
    }

    /// The block of each hexahedron.
    pub fn blocks(&self) -> &Groups {
        &self.blocks
    }

    /// The faces of the outside.
    pub fn boundary(&self) -> &[HexFace] {
        &self.boundary
    }

    /// The patch of each face of the outside.
    pub fn patches(&self) -> &Groups {
        &self.patches
    }

    /// The side of each face of the outside; all of a patch are in one.
    pub fn sides(&self) -> &Groups {
        &self.sides
    }

    /// The sides, unless they are the patches.
    pub(super) fn sides_apart(&self) -> Option<&Groups> {
        Some(&self.sides).filter(|sides| **sides != self.patches)
    }

    /// The side that a patch with these faces is in.
    pub(super) fn side_of(&self, faces: &[u32]) -> usize {
        faces.first().map_or(0, |&face| self.sides.of[face as usize] as usize)
    }

    /// The vertices of face `i` of the outside, counter-clockwise seen from there.
    pub(super) fn quad(&self, i: u32) -> [u32; 4] {
        self.boundary[i as usize].vertices(self.cells())
    }
}

fn check_count(what: &str, groups: &Groups, count: usize) -> Result<()> {
    if groups.of.len() == count {
        return Ok(());
    }
    let message = format!("{what} are told of {} elements, not of {count}", groups.of.len());
    Err(Error::new(ErrorKind::Mismatch, message).remedy("give one group for each"))
}

fn check_boundary(all: &Cells, cells: &[[u32; 8]], boundary: &[HexFace]) -> Result<()> {
    let known = |side: &&HexFace| (side.cell as usize) < cells.len() && side.face < 6;
    let mut sides: Vec<HexFace> = boundary.iter().filter(known).copied().collect();
    sides.sort_unstable();
    let outside = all.boundary()?;
    let wrong = sides.iter().zip(&outside).position(|(side, face)| side.vertices(cells) != face.vertices());
    if let Some(i) = wrong {
        let message = "its faces told are not those of the outside";
        return Err(Error::new(ErrorKind::Mismatch, message).at(Place::Cell(sides[i].cell)).remedy(EACH));
    }
    if boundary.len() != outside.len() || sides.len() != outside.len() {
        let message = format!("the outside has {} faces, not {}", outside.len(), boundary.len());
        return Err(Error::new(ErrorKind::Mismatch, message).remedy(EACH));
    }
    Ok(())
}

const EACH: &str = "give every face that only one hexahedron has, once";

fn check_nested(patches: &Groups, sides: &Groups) -> Result<()> {
    let mut first = vec![None; patches.names.len()];
    for (&patch, &side) in patches.of.iter().zip(&sides.of) {
        if *first[patch as usize].get_or_insert(side) != side {
            let message = format!("{} is in more sides than one", patches.names[patch as usize]);
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("cut it, or join the sides"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::{hex_box, tet_box};

    fn groups(count: usize) -> Groups {
        Groups::numbered("all", vec![0; count]).unwrap()
    }

    fn all_faces() -> Vec<HexFace> {
        (0..6).map(|face| HexFace { cell: 0, face }).collect()
    }

    fn refused(mesh: &Mesh, boundary: Vec<HexFace>, patches: Groups, sides: Groups) -> ErrorKind {
        GroupedHexes::new(mesh, groups(mesh.cells().len()), boundary, patches, sides).unwrap_err().kind
    }

    #[test]
    fn names_are_such_as_every_format_takes() {
        for bad in ["", "1st", "-x", "a b", "a-b", "\u{e9}", &"a".repeat(81)] {
            let error = Groups::new(vec![bad.to_owned()], vec![]).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Option, "{bad}");
        }
        assert!(Groups::new(vec!["inlet".into(), "Inlet".into()], vec![]).is_err());
        assert_eq!(Groups::new(vec!["a".into()], vec![0, 1]).unwrap_err().kind, ErrorKind::Mismatch);
        let groups = Groups::new(vec!["a".into(), "b".into(), "c_1".into()], vec![2, 0, 2]).unwrap();
        let members: Vec<_> = groups.members().collect();
        assert_eq!(members, [(0, "a", vec![1]), (2, "c_1", vec![0, 2])]);
    }

    #[test]
    fn the_boundary_is_all_of_the_outside_once() {
        let cube = hex_box([1, 1, 1]);
        GroupedHexes::new(&cube, groups(1), all_faces(), groups(6), groups(6)).unwrap();
        let few = all_faces()[1..].to_vec();
        assert_eq!(refused(&cube, few.clone(), groups(5), groups(5)), ErrorKind::Mismatch);
        let twice = [few.clone(), vec![few[0]]].concat();
        assert_eq!(refused(&cube, twice, groups(6), groups(6)), ErrorKind::Mismatch);
        for unknown in [HexFace { cell: 0, face: 6 }, HexFace { cell: 1, face: 0 }] {
            assert_eq!(
                refused(&cube, [few.clone(), vec![unknown]].concat(), groups(6), groups(6)),
                ErrorKind::Mismatch
            );
        }
        let inner = [all_faces(), all_faces().into_iter().map(|f| HexFace { cell: 1, ..f }).collect()].concat();
        assert_eq!(refused(&hex_box([2, 1, 1]), inner, groups(12), groups(12)), ErrorKind::Mismatch);
    }

    #[test]
    fn groups_go_with_the_mesh_and_patches_with_sides() {
        let cube = hex_box([1, 1, 1]);
        assert_eq!(refused(&cube, all_faces(), groups(5), groups(6)), ErrorKind::Mismatch);
        let split = Groups::numbered("side", vec![0, 0, 0, 1, 1, 1]).unwrap();
        GroupedHexes::new(&cube, groups(1), all_faces(), split.clone(), groups(6)).unwrap();
        assert_eq!(refused(&cube, all_faces(), groups(6), split), ErrorKind::Mismatch);
        assert_eq!(refused(&tet_box([1, 1, 1]), vec![], groups(0), groups(0)), ErrorKind::Unsupported);
    }
}
