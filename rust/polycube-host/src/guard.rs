//! Panics made errors.

use polycube::{Error, ErrorKind};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Does `work`; a panic becomes an error of [`ErrorKind::Internal`] with the message of the panic.
///
/// # Errors
/// Those of `work`, and that of its panic.
pub fn guard<T, E: From<Error>>(work: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| Err(panicked(&*payload).into()))
}

fn panicked(payload: &(dyn Any + Send)) -> Error {
    let text = payload.downcast_ref::<&str>().copied().or(payload.downcast_ref::<String>().map(String::as_str));
    Error::new(ErrorKind::Internal, format!("a fault of the library: {}", text.unwrap_or("no message")))
        .remedy("report it together with the mesh; your data is unchanged")
}
