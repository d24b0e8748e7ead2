//! Plot3D's text.

use super::*;

#[test]
fn blocks_have_all_their_points_x_first() {
    let mesh = box_mesh();
    let hexes = grouped(&mesh);
    let text = texts(SolverFormat::Xyz, &hexes).remove(0);
    let mut words = text.split_whitespace();
    let mut next = || words.next().unwrap().to_owned();
    let count: usize = next().parse().unwrap();
    let sizes: Vec<[usize; 3]> = (0..count).map(|_| [(); 3].map(|()| next().parse().unwrap())).collect();
    assert_eq!(sizes, [[2, 3, 3], [3, 3, 3]]);
    for (block, size) in Blocks::new(&hexes).unwrap().blocks.iter().zip(sizes) {
        let all: Vec<f64> = (0..3 * size.iter().product::<usize>()).map(|_| next().parse().unwrap()).collect();
        let expected = (0..3).flat_map(|a| block.vertices.iter().map(move |&v| (v, a)));
        assert!(expected.map(|(v, a)| mesh.points()[v as usize][a]).eq(all));
    }
    assert_eq!(words.next(), None);
}
