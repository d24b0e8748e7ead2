//! What a run writes: files, and what people read meanwhile and in the end.

pub mod colour;
pub mod folder;
pub mod front;
pub mod progress;
pub mod report;
pub mod table;
pub mod terminal;
