//! Numbers that a file carries per cell.

use crate::error::{Error, ErrorKind, Result};

/// The numbers of a field, one per cell.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValues {
    /// Double precision numbers.
    Real(Vec<f64>),
    /// Whole numbers.
    Integer(Vec<i32>),
}

/// A named number per cell, in the order of the mesh's cells.
#[derive(Clone, Debug, PartialEq)]
pub struct CellField {
    /// Letters, digits and `_ - . :` only.
    pub name: String,
    /// One value per cell.
    pub values: FieldValues,
}

impl FieldValues {
    /// Number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Real(v) => v.len(),
            Self::Integer(v) => v.len(),
        }
    }

    /// Whether there is no value.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl CellField {
    /// A field of double precision numbers.
    pub fn real(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), values: FieldValues::Real(values) }
    }

    /// A field of whole numbers.
    pub fn integer(name: impl Into<String>, values: Vec<i32>) -> Self {
        Self { name: name.into(), values: FieldValues::Integer(values) }
    }
}

/// Refuses fields of a wrong length, and names that a format could not hold or would confuse.
pub(super) fn check_fields(fields: &[CellField], cells: usize) -> Result<()> {
    for (i, field) in fields.iter().enumerate() {
        let name = &field.name;
        if field.values.len() != cells {
            let message = format!("field {name:?} has {} values for {cells} cells", field.values.len());
            return Err(Error::new(ErrorKind::Option, message).remedy("give one value per cell"));
        }
        let plain = |c: char| c.is_ascii_alphanumeric() || "_-.:".contains(c);
        if name.is_empty() || !name.chars().all(plain) || name == "vertex_indices" {
            let message = format!("a field cannot be named {name:?}");
            return Err(Error::new(ErrorKind::Option, message).remedy("use letters, digits and _ - . : only"));
        }
        if fields[..i].iter().any(|other| other.name == *name) {
            let message = format!("two fields are named {name:?}");
            return Err(Error::new(ErrorKind::Option, message).remedy("rename one of them"));
        }
    }
    Ok(())
}
