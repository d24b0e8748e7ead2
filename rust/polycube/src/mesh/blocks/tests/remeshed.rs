//! The blocks of hexahedra that `remesh` makes.

use super::*;
use crate::align::Strategy;
use crate::context::Context;
use crate::generate::{Cuboid, Example, Voxels, example};
use crate::mesh::CellKind;
use crate::remesh::{RemeshOptions, Remeshed, Size, remesh};
use crate::simplify::{Input, SimplifyOptions};

fn remeshed((polycube, shape): &(Mesh, Mesh), padding: usize) -> Remeshed {
    let input = Input { polycube, shape: Some(shape), labels: None };
    let simplify = SimplifyOptions { strategy: Strategy::Paper, ..SimplifyOptions::default() };
    let size = Some(Size::Hexes(300));
    let options = RemeshOptions { simplify, size, padding, max_hausdorff: 1.0, ..RemeshOptions::default() };
    remesh(&input, &options, &Context::default()).unwrap()
}

/// A cube with a void: its surface has two parts.
fn hollow() -> (Mesh, Mesh) {
    let cube = |low, high| Cuboid::new([low; 3], [high; 3]);
    let mesh = Voxels::from_difference(&[cube(0, 6)], &[cube(2, 4)]).unwrap().mesh(CellKind::Hexahedra, 1.0).unwrap();
    (mesh.clone(), mesh)
}

/// Padding is as many layers thick wherever it lies around one part of the surface, and its edges run outward.
#[test]
fn padding_is_one_class_around_each_part_of_the_surface() {
    for (pair, parts) in [
        (example(Example::SteppedL, 1, CellKind::Quads).unwrap(), 1),
        (example(Example::Ring, 1, CellKind::Hexahedra).unwrap(), 1),
        (hollow(), 2),
    ] {
        let result = remeshed(&pair, 2);
        let hexes = result.hexes.as_ref().unwrap().grouped().unwrap();
        let blocks = Blocks::new(&hexes).unwrap();
        check(&hexes, &blocks);
        assert_eq!(blocks.blocks.len(), result.report.hex_blocks);
        let after = result.report.simplify.after.as_ref().unwrap();
        let padding = &blocks.blocks[after.blocks..];
        assert_eq!(padding.len(), after.blocks_padded - after.blocks);
        let layers: BTreeSet<(u32, i8)> = padding.iter().map(|block| (block.class[2], block.sign[2])).collect();
        assert_eq!(layers.len(), parts);
        assert!(layers.iter().all(|&(class, sign)| blocks.classes[class as usize] == 2 && sign == 1));
        assert!(padding.iter().all(|block| matches!(block.faces[5], Beyond::Outside { .. })));
        // No other edge is of these classes.
        let inside = blocks.blocks[..after.blocks].iter().flat_map(|block| block.class);
        let across = padding.iter().flat_map(|block| [block.class[0], block.class[1]]);
        assert!(inside.chain(across).all(|class| layers.iter().all(|&(layer, _)| layer != class)));
    }
}

#[test]
fn without_padding_blocks_are_those_of_the_lattice() {
    let result = remeshed(&example(Example::Ring, 1, CellKind::Quads).unwrap(), 0);
    let hexes = result.hexes.as_ref().unwrap().grouped().unwrap();
    let blocks = Blocks::new(&hexes).unwrap();
    check(&hexes, &blocks);
    let straight = |beyond: &Beyond| match beyond {
        Beyond::Block(there) => there.transform == [1, 2, 3],
        Beyond::Outside { .. } => true,
    };
    assert!(blocks.blocks.iter().all(|block| block.sign == [1; 3] && block.faces.iter().all(straight)));
}
