//! Binary MEDIT, `.meshb`, versions 1 to 4; references of vertices are ignored when read.

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::io::scalar::{Endian, Scalar, whole};
use crate::mesh::io::scan::Scanner;
use crate::mesh::io::soup::Soup;
use crate::mesh::{CellKind, Mesh, Point};

/// Numbers of keywords.
const DIMENSION: i64 = 3;
const VERTICES: i64 = 4;
const TRIANGLES: i64 = 6;
const QUADRILATERALS: i64 = 7;
const TETRAHEDRA: i64 = 8;
const PRISMS: i64 = 9;
const HEXAHEDRA: i64 = 10;
const PYRAMIDS: i64 = 49;
const END: i64 = 54;
/// Those of cells with nodes on their edges.
const QUADRATIC: [i64; 4] = [24, 27, 30, 33];

/// Reads a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut file = File::new(bytes)?;
    while file.scanner.remaining() > 0 {
        let keyword = file.integer(Scalar::I32)?;
        if keyword == END {
            break;
        }
        let next = file.integer(file.position)?;
        file.section(keyword)?;
        file.go_to(next)?;
    }
    Ok(file.soup)
}

struct File<'a> {
    scanner: Scanner<'a>,
    length: usize,
    endian: Endian,
    /// The types of coordinates, of places in the file, and of counts and vertices.
    real: Scalar,
    position: Scalar,
    whole: Scalar,
    soup: Soup,
}

impl<'a> File<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self> {
        let mut scanner = Scanner::new(bytes);
        let endian = match scanner.take(4, "the number 1")? {
            [1, 0, 0, 0] => Endian::Little,
            [0, 0, 0, 1] => Endian::Big,
            _ => {
                let error = Error::new(ErrorKind::Parse, "this is no binary MEDIT file");
                return Err(error.remedy("give a text file the extension .mesh"));
            }
        };
        let version = Scalar::I32.read(scanner.take(4, "the version")?, endian);
        if !(1.0..=4.0).contains(&version) {
            return Err(Error::new(ErrorKind::Unsupported, format!("version {version} of MEDIT's binary format")));
        }
        let real = if version < 2.0 { Scalar::F32 } else { Scalar::F64 };
        let position = if version < 3.0 { Scalar::I32 } else { Scalar::I64 };
        let whole = if version < 4.0 { Scalar::I32 } else { Scalar::I64 };
        Ok(Self { scanner, length: bytes.len(), endian, real, position, whole, soup: Soup::default() })
    }

    fn number(&mut self, scalar: Scalar) -> Result<f64> {
        Ok(scalar.read(self.scanner.take(scalar.size(), "a number")?, self.endian))
    }

    fn integer(&mut self, scalar: Scalar) -> Result<i64> {
        Ok(self.number(scalar)? as i64)
    }

    /// Moves on to a place in the file; 0 is its end.
    fn go_to(&mut self, place: i64) -> Result<()> {
        let at = self.length - self.scanner.remaining();
        let place = if place == 0 { Some(self.length) } else { usize::try_from(place).ok() };
        let ahead = place.and_then(|place| place.checked_sub(at));
        let ahead =
            ahead.ok_or_else(|| Error::new(ErrorKind::Parse, "a section of the file is longer than it says"))?;
        self.scanner.take(ahead, "a section").map(|_| ())
    }

    fn section(&mut self, keyword: i64) -> Result<()> {
        match keyword {
            DIMENSION => self.dimension(),
            VERTICES => self.vertices(),
            TRIANGLES => self.cells(|soup, c: &[u32; 3]| soup.polygon(c, 0)),
            QUADRILATERALS => self.cells(|soup, c: &[u32; 4]| soup.polygon(c, 0)),
            TETRAHEDRA => self.cells(|soup, c| {
                soup.tetrahedron(*c, 0);
                Ok(())
            }),
            HEXAHEDRA => self.cells(|soup, c| {
                soup.hexahedron(*c, 0);
                Ok(())
            }),
            PRISMS | PYRAMIDS => self.none_of("prisms or pyramids", "export tetrahedra only or hexahedra only"),
            _ if QUADRATIC.contains(&keyword) => {
                self.none_of("quadratic cells", "export linear cells, without nodes on edges")
            }
            _ => Ok(()),
        }
    }

    fn dimension(&mut self) -> Result<()> {
        match self.integer(Scalar::I32)? {
            3 => Ok(()),
            other => Err(Error::new(ErrorKind::Unsupported, format!("a mesh of dimension {other}"))
                .remedy("export the mesh with three coordinates per vertex")),
        }
    }

    fn none_of(&mut self, what: &str, remedy: &str) -> Result<()> {
        if self.integer(self.whole)? == 0 {
            return Ok(());
        }
        Err(Error::new(ErrorKind::Unsupported, format!("the file holds {what}")).remedy(remedy))
    }

    fn vertices(&mut self) -> Result<()> {
        if !self.soup.points.is_empty() {
            return Err(Error::new(ErrorKind::Parse, "a second list of vertices"));
        }
        for _ in 0..self.integer(self.whole)? {
            let mut point = Point::origin();
            for x in point.iter_mut() {
                *x = self.number(self.real)?;
            }
            self.number(self.whole)?;
            self.soup.points.push(point);
        }
        Ok(())
    }

    fn cells<const N: usize>(&mut self, add: impl Fn(&mut Soup, &[u32; N]) -> Result<()>) -> Result<()> {
        for _ in 0..self.integer(self.whole)? {
            let mut corners = [0; N];
            for corner in &mut corners {
                *corner = whole(self.number(self.whole)? - 1.0)?;
            }
            add(&mut self.soup, &corners)?;
            let reference = self.integer(self.whole)?;
            self.soup.tag(Some(reference));
        }
        Ok(())
    }
}

/// Writes version 3: double precision, and room for files of any size.
pub(super) fn write(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    put(&mut bytes, 1);
    put(&mut bytes, 3);
    section(&mut bytes, DIMENSION, |bytes| put(bytes, 3));
    section(&mut bytes, VERTICES, |bytes| {
        put(bytes, mesh.points().len());
        for point in mesh.points() {
            point.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            put(bytes, 0);
        }
    });
    let keyword = match mesh.cells().kind() {
        CellKind::Triangles => TRIANGLES,
        CellKind::Quads => QUADRILATERALS,
        CellKind::Tetrahedra => TETRAHEDRA,
        CellKind::Hexahedra => HEXAHEDRA,
    };
    section(&mut bytes, keyword, |bytes| {
        put(bytes, mesh.cells().len());
        for i in 0..mesh.cells().len() {
            mesh.cells().cell(i).iter().for_each(|&v| put(bytes, v as usize + 1));
            put(bytes, 0);
        }
    });
    put(&mut bytes, END as usize);
    bytes.extend(0_u64.to_le_bytes());
    bytes
}

/// Four bytes.
fn put(bytes: &mut Vec<u8>, number: usize) {
    bytes.extend((number as u32).to_le_bytes());
}

/// A keyword, where the next begins, and what lies between.
fn section(bytes: &mut Vec<u8>, keyword: i64, contents: impl FnOnce(&mut Vec<u8>)) {
    put(bytes, keyword as usize);
    let at = bytes.len();
    bytes.extend([0; 8]);
    contents(bytes);
    let next = (bytes.len() as u64).to_le_bytes();
    bytes[at..at + 8].copy_from_slice(&next);
}
