//! Stanford PLY: the positions of the element `vertex` and the corners of the element `face`.

mod header;

use crate::error::{Error, ErrorKind, Result};
use crate::mesh::io::field::{CellField, FieldValues};
use crate::mesh::io::scalar::{Scalar, whole};
use crate::mesh::io::scan::Scanner;
use crate::mesh::io::soup::Soup;
use crate::mesh::io::text::Text;
use crate::mesh::{Mesh, Point};
use header::{Element, Encoding, Property, header};

/// Reads a mesh; all other elements and properties are ignored.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut scanner = Scanner::new(bytes);
    let (encoding, elements) = header(&mut scanner)?;
    let mut body = Body { scanner, encoding };
    let mut soup = Soup::default();
    for element in &elements {
        match element.name.as_slice() {
            b"vertex" => body.vertices(element, &mut soup)?,
            b"face" => body.faces(element, &mut soup)?,
            _ => body.skip(element)?,
        }
    }
    Ok(soup)
}

struct Body<'a> {
    scanner: Scanner<'a>,
    encoding: Encoding,
}

impl Body<'_> {
    fn value(&mut self, scalar: Scalar) -> Result<f64> {
        match self.encoding {
            Encoding::Text => self.scanner.float("a number"),
            Encoding::Binary(endian) => {
                let bytes = self.scanner.take(scalar.size(), "a number")?;
                Ok(scalar.read(bytes, endian))
            }
        }
    }

    fn whole(&mut self, scalar: Scalar) -> Result<u32> {
        let value = self.value(scalar)?;
        whole(value).map_err(|error| self.scanner.error(error.message))
    }

    fn vertices(&mut self, element: &Element, soup: &mut Soup) -> Result<()> {
        let axes = ["x", "y", "z"].map(|axis| {
            let found = element.find(&[axis]);
            found.filter(|&i| element.properties[i].length.is_none())
        });
        let [Some(x), Some(y), Some(z)] = axes else {
            return Err(self.scanner.error("the vertices have no x, y and z"));
        };
        soup.points.reserve(self.scanner.capacity(element.count, 3));
        for _ in 0..element.count {
            let mut point = Point::origin();
            for (i, property) in element.properties.iter().enumerate() {
                let value = self.property(property)?;
                if let Some(axis) = [x, y, z].iter().position(|&p| p == i) {
                    point[axis] = value;
                }
            }
            soup.points.push(point);
        }
        Ok(())
    }

    /// Reads one property: the number itself, or the length of a list.
    fn property(&mut self, property: &Property) -> Result<f64> {
        let Some(length) = property.length else {
            return self.value(property.scalar);
        };
        let count = self.whole(length)?;
        for _ in 0..count {
            self.value(property.scalar)?;
        }
        Ok(f64::from(count))
    }

    fn faces(&mut self, element: &Element, soup: &mut Soup) -> Result<()> {
        let list = element.find(&["vertex_indices", "vertex_index"]);
        let list = list.filter(|&i| element.properties[i].length.is_some());
        let Some(list) = list.or((element.count == 0).then_some(0)) else {
            return Err(self.scanner.error("the faces have no list vertex_indices"));
        };
        let mut corners = Vec::new();
        for _ in 0..element.count {
            for (i, property) in element.properties.iter().enumerate() {
                match property.length {
                    Some(length) if i == list => self.corners(length, property.scalar, &mut corners)?,
                    _ => {
                        self.property(property)?;
                    }
                }
            }
            soup.polygon(&corners, self.line())?;
        }
        Ok(())
    }

    fn corners(&mut self, length: Scalar, scalar: Scalar, corners: &mut Vec<u32>) -> Result<()> {
        corners.clear();
        for _ in 0..self.whole(length)? {
            corners.push(self.whole(scalar)?);
        }
        Ok(())
    }

    fn line(&self) -> usize {
        match self.encoding {
            Encoding::Text => self.scanner.line(),
            Encoding::Binary(_) => 0,
        }
    }

    fn skip(&mut self, element: &Element) -> Result<()> {
        if element.properties.is_empty() {
            return Ok(());
        }
        if element.name == b"tristrips" && element.count > 0 {
            let message = "the faces are triangle strips";
            return Err(Error::new(ErrorKind::Unsupported, message).remedy("export the faces as polygons"));
        }
        for _ in 0..element.count {
            for property in &element.properties {
                self.property(property)?;
            }
        }
        Ok(())
    }
}

/// Writes a surface as binary little endian, with the fields as properties of the faces.
pub(super) fn write(mesh: &Mesh, fields: &[CellField]) -> Vec<u8> {
    let mut text = Text::default();
    text.put("ply\nformat binary_little_endian 1.0\nelement vertex ");
    text.put(mesh.points().len()).end();
    text.put("property double x\nproperty double y\nproperty double z\nelement face ");
    text.put(mesh.cells().len()).end();
    text.put("property list uchar uint vertex_indices").end();
    for field in fields {
        let kind = match field.values {
            _ if is_colour(field) => "uchar",
            FieldValues::Real(_) => "double",
            FieldValues::Integer(_) => "int",
        };
        text.put(format_args!("property {kind} {}", field.name)).end();
    }
    text.put("end_header").end();
    let mut bytes = text.into_bytes();
    let coordinates = mesh.points().iter().flat_map(|p| p.iter());
    bytes.extend(coordinates.flat_map(|x| x.to_le_bytes()));
    for i in 0..mesh.cells().len() {
        let corners = mesh.cells().cell(i);
        bytes.push(corners.len() as u8);
        bytes.extend(corners.iter().flat_map(|v| v.to_le_bytes()));
        for field in fields {
            match &field.values {
                FieldValues::Integer(v) if is_colour(field) => bytes.push(v[i].clamp(0, 255) as u8),
                FieldValues::Real(v) => bytes.extend(v[i].to_le_bytes()),
                FieldValues::Integer(v) => bytes.extend(v[i].to_le_bytes()),
            }
        }
    }
    bytes
}

/// Whether other programs take the field for a part of the face's colour.
fn is_colour(field: &CellField) -> bool {
    matches!(field.values, FieldValues::Integer(_)) && ["red", "green", "blue", "alpha"].contains(&field.name.as_str())
}
