//! What a file looks like, whatever its name says.

use super::Format;
use super::scan::without_mark;

/// How much of a file is looked at.
const BEGINNING: usize = 4096;

/// The format that the beginning of a file is typical of; nothing for binary STL, which is like any other bytes.
pub(super) fn format(bytes: &[u8]) -> Option<Format> {
    let text = without_mark(&bytes[..bytes.len().min(BEGINNING)]).trim_ascii_start();
    if text.starts_with(b"# vtk DataFile") {
        return Some(Format::Vtk);
    }
    if text.starts_with(b"<") {
        let has = |word: &[u8]| text.windows(word.len()).any(|w| w == word);
        let kind = if has(b"\"PolyData\"") { Format::Vtp } else { Format::Vtu };
        return has(b"VTKFile").then_some(kind);
    }
    if matches!(bytes, [1, 0, 0, 0, ..] | [0, 0, 0, 1, ..]) {
        return Some(Format::Meshb);
    }
    let mut lines = text.split(|&b| b == b'\n').map(<[u8]>::trim_ascii);
    let line = lines.find(|line| !line.is_empty() && !line.starts_with(b"#"))?;
    match line.split(u8::is_ascii_whitespace).next()? {
        b"ply" => Some(Format::Ply),
        b"$MeshFormat" => Some(Format::Msh),
        word if word.starts_with(b"*") => Some(Format::Inp),
        b"v" | b"vn" | b"vt" | b"f" | b"o" | b"g" | b"s" | b"mtllib" | b"usemtl" => Some(Format::Obj),
        word if word.eq_ignore_ascii_case(b"MeshVersionFormatted") => Some(Format::Medit),
        word if word.eq_ignore_ascii_case(b"solid") => Some(Format::Stl),
        word if word.ends_with(b"OFF") => Some(Format::Off),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::io::tests::sample;
    use crate::mesh::{CellKind, write_bytes};

    #[test]
    fn what_is_written_is_recognised() {
        for known in Format::ALL {
            let bytes = write_bytes(known, &sample(CellKind::Triangles), &[]).unwrap();
            assert_eq!(format(&bytes), Some(known).filter(|&f| f != Format::Stl));
        }
        assert_eq!(format(b"\xef\xbb\xbf# by a program\n\n  mtllib a.mtl\n"), Some(Format::Obj));
        assert_eq!(format(b"SOLID x\n"), Some(Format::Stl));
        assert_eq!(format(b"COFF\n1 1 1\n"), Some(Format::Off));
        for unknown in [&b""[..], b"\n\n", b"#", b"<svg>", b"\xff\xfe\0", b"volume 3"] {
            assert_eq!(format(unknown), None);
        }
    }
}
