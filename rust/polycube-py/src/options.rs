//! Keyword arguments as options of the library.

use crate::arrays;
use crate::errors;
use polycube::align::{Effort, Guides, SolverKind, Strategy};
use polycube::layout::Objective;
use polycube::make::{Axes, MakeOptions};
use polycube::mesh::Mesh;
use polycube::remesh::{RemeshOptions, Size};
use polycube::simplify::SimplifyOptions;
use polycube::structure::Tolerance;
use pyo3::conversion::FromPyObjectOwned;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::time::Duration;

/// The keyword arguments of a call, taken one by one; what is left over was a mistake.
pub struct Keywords<'py> {
    function: &'static str,
    left: Bound<'py, PyDict>,
}

impl<'py> Keywords<'py> {
    /// The arguments of `function`.
    pub fn new(py: Python<'py>, function: &'static str, given: Option<&Bound<'py, PyDict>>) -> PyResult<Self> {
        let left = given.map_or_else(|| Ok(PyDict::new(py)), |given| given.copy())?;
        Ok(Self { function, left })
    }

    fn py(&self) -> Python<'py> {
        self.left.py()
    }

    /// Takes an argument; nothing where it was not given or is None.
    pub fn take<T: FromPyObjectOwned<'py>>(&self, name: &str) -> PyResult<Option<T>> {
        let Some(value) = self.left.get_item(name)? else {
            return Ok(None);
        };
        self.left.del_item(name)?;
        if value.is_none() {
            return Ok(None);
        }
        let wrong = |e: T::Error| {
            let e: PyErr = e.into();
            PyTypeError::new_err(format!("{}(): {name}: {}", self.function, e.value(self.py())))
        };
        value.extract().map(Some).map_err(wrong)
    }

    /// Takes a whole number, also as a float without a fraction.
    fn whole<T: FromPyObjectOwned<'py>>(&self, name: &str) -> PyResult<Option<T>> {
        if let Some(value) = self.left.get_item(name)?
            && value.call_method0("is_integer").and_then(|whole| whole.is_truthy()).unwrap_or(false)
        {
            self.left.set_item(name, value.call_method0("__int__")?)?;
        }
        self.take(name)
    }

    /// Takes a number that `holds` must accept.
    fn number(&self, name: &str, range: &str, holds: impl Fn(f64) -> bool) -> PyResult<Option<f64>> {
        let number: Option<f64> = self.take(name)?;
        match number {
            Some(x) if !holds(x) => {
                Err(errors::option(self.py(), format!("{name} is {x}"), &format!("give a number {range}")))
            }
            number => Ok(number),
        }
    }

    fn positive(&self, name: &str) -> PyResult<Option<f64>> {
        self.number(name, "above 0", |x| x.is_finite() && x > 0.0)
    }

    fn fraction(&self, name: &str) -> PyResult<Option<f64>> {
        self.number(name, "from 0 to 1", |x| (0.0..=1.0).contains(&x))
    }

    /// Takes one of a few words.
    fn word<T: Copy>(&self, name: &str, words: &[(&str, T)]) -> PyResult<Option<T>> {
        let Some(word) = self.take::<String>(name)? else {
            return Ok(None);
        };
        let found = words.iter().find(|(known, _)| *known == word);
        let known: Vec<&str> = words.iter().map(|(known, _)| *known).collect();
        let wrong = || errors::option(self.py(), format!("{name} is {word:?}"), &format!("use {}", known.join(", ")));
        found.map(|(_, value)| Some(*value)).ok_or_else(wrong)
    }

    /// Refuses what was not taken.
    pub fn finish(self) -> PyResult<()> {
        match self.left.keys().iter().next() {
            None => Ok(()),
            Some(name) => {
                Err(PyTypeError::new_err(format!("{}() got an unexpected keyword argument '{name}'", self.function)))
            }
        }
    }

    /// Refuses arguments that have no effect, with the reason and the remedy.
    pub fn refuse(&self, names: &[&str], reason: &str, remedy: &str) -> PyResult<()> {
        for name in names {
            if self.take::<Bound<'py, PyAny>>(name)?.is_some() {
                return Err(errors::option(self.py(), format!("{name} has no effect: {reason}"), remedy));
            }
        }
        Ok(())
    }

    /// Takes whether the input is taken as it is.
    pub fn no_repair(&self) -> PyResult<bool> {
        Ok(self.take("no_repair")?.unwrap_or_default())
    }

    /// Takes how a polycube is made of a shape, all but whether that is repaired.
    pub fn make(&self) -> PyResult<MakeOptions> {
        if let Some(labels) = self.labels()? {
            let reason = "the labels say which facets there are";
            self.refuse(&["detail", "corners", "axes"], reason, "leave it out, or the labels")?;
            return Ok(MakeOptions { labels: Some(labels), ..MakeOptions::default() });
        }
        let detail = self.take("detail")?.unwrap_or(MakeOptions::default().detail);
        let axes = self.word("axes", &[("keep", Axes::Keep), ("best", Axes::Best)])?.unwrap_or_default();
        let options = MakeOptions { detail, corners: self.whole("corners")?, axes, ..MakeOptions::default() };
        options.check().map_err(|e| errors::raise(self.py(), &e, None))?;
        Ok(options)
    }

    /// Takes the labels of the polycube's boundary faces.
    pub fn labels(&self) -> PyResult<Option<Vec<i8>>> {
        self.take::<Bound<'py, PyAny>>("labels")?.map(|labels| crate::mesh::labels(&labels)).transpose()
    }

    /// Turns a mask of the boundary faces of `polycube` that must not move into their numbers.
    pub fn number_faces(&self, polycube: &Mesh) -> PyResult<()> {
        let Some(faces) = self.left.get_item("locked_faces")? else {
            return Ok(());
        };
        // A mesh that has no boundary is refused for that later.
        let count = polycube.cells().boundary().map_or(0, |faces| faces.len());
        self.left.set_item("locked_faces", arrays::numbers_of("locked_faces", &faces, count)?)
    }

    /// Takes the boundary faces whose facets must not move.
    fn locked_faces(&self) -> PyResult<Vec<usize>> {
        let Some(faces) = self.take::<Bound<'py, PyAny>>("locked_faces")? else {
            return Ok(Vec::new());
        };
        let (faces, _) = arrays::whole("locked_faces").read::<i64>(&faces)?;
        let faces: Result<_, _> = faces.into_iter().map(usize::try_from).collect();
        faces.map_err(|_| errors::option(self.py(), "locked_faces has a negative number", "give faces from 0 on"))
    }

    /// Takes how far the mesh may be from a polycube.
    pub fn tolerance(&self) -> PyResult<Tolerance> {
        let default = Tolerance::default();
        let degrees = self.number("angle_tolerance", "of degrees from 0 to 45", |x| (0.0..=45.0).contains(&x))?;
        Ok(Tolerance {
            degrees: degrees.unwrap_or(default.degrees),
            distance: self.fraction("level_tolerance")?.unwrap_or(default.distance),
            ..default
        })
    }

    /// Takes how a polycube is simplified, all but its size.
    fn method(&self) -> PyResult<SimplifyOptions> {
        const STRATEGIES: [(&str, Strategy); 3] =
            [("best", Strategy::Best), ("paper", Strategy::Paper), ("naive", Strategy::Naive)];
        const OBJECTIVES: [(&str, Objective); 3] = [
            ("blocks_padded", Objective::BlocksPadded),
            ("blocks", Objective::Blocks),
            ("surface_patches", Objective::SurfacePatches),
        ];
        const SOLVERS: [(&str, SolverKind); 2] = [("exact", SolverKind::Exact), ("linear", SolverKind::Linear)];
        Ok(SimplifyOptions {
            strategy: self.word("strategy", &STRATEGIES)?.unwrap_or_default(),
            scale: None,
            lambda_min: self.take("lambda_min")?.unwrap_or(0.0),
            solver: self.word("solver", &SOLVERS)?.unwrap_or_default(),
            objective: self.word("objective", &OBJECTIVES)?,
            effort: self.effort()?,
            simplicity: self.take("simplicity")?,
            max_displacement: self.take("max_displacement")?,
            max_distortion: self.take("max_distortion")?,
            guides: self.guides()?,
            tolerance: self.tolerance()?,
            no_repair: self.no_repair()?,
            ..SimplifyOptions::default()
        })
    }

    /// Takes guides as the dictionary that a guide file of the command holds.
    fn guides(&self) -> PyResult<Guides> {
        let Some(given) = self.take::<Bound<'py, PyAny>>("guides")? else {
            return Ok(Guides { fixed_faces: self.locked_faces()?, ..Guides::default() });
        };
        let text: String = self.py().import("json")?.call_method1("dumps", (given,))?.extract()?;
        let remedy = "give {\"fixed\": [facet], \"together\": [[facet, facet]], \"apart\": [[facet, facet]], \
                      \"symmetry\": [{\"axis\": 0, \"at\": 0.0}]}";
        let guides: Guides =
            serde_json::from_str(&text).map_err(|e| errors::option(self.py(), format!("guides: {e}"), remedy))?;
        let fixed_faces = [guides.fixed_faces, self.locked_faces()?].concat();
        Ok(Guides { fixed_faces, ..guides })
    }

    fn effort(&self) -> PyResult<Effort> {
        let default = Effort::default();
        let seconds = self.positive("time_limit")?;
        let limit = seconds.map(Duration::try_from_secs_f64).transpose();
        let limit = limit.map_err(|e| errors::option(self.py(), format!("time_limit: {e}"), "give fewer seconds"))?;
        Ok(Effort {
            steps_per_level: self.whole("steps")?.unwrap_or(default.steps_per_level),
            proof_nodes: self.whole("proof_nodes")?.unwrap_or(default.proof_nodes),
            time_limit: limit,
        })
    }

    /// Takes how a polycube is simplified.
    pub fn simplify(&self) -> PyResult<SimplifyOptions> {
        let (scale, length) = (self.take("scale")?, self.positive("edge_length")?);
        if scale.is_some() && length.is_some() {
            return Err(errors::option(
                self.py(),
                "scale and edge_length say the same thing twice",
                "give one of them",
            ));
        }
        let options = SimplifyOptions { scale: scale.or(length.map(f64::recip)), ..self.method()? };
        options.check().map_err(|e| errors::raise(self.py(), &e, None))?;
        Ok(options)
    }

    /// Takes how a shape is meshed.
    pub fn remesh(&self) -> PyResult<RemeshOptions> {
        let default = RemeshOptions::default();
        let options = RemeshOptions {
            size: self.size()?,
            padding: self.whole("padding")?.unwrap_or(default.padding),
            surface_only: self.take("surface_only")?.unwrap_or(false),
            max_hausdorff: self.positive("max_hausdorff")?.map_or(default.max_hausdorff, |percent| percent / 100.0),
            simplify: self.method()?,
        };
        options.check().map_err(|e| errors::raise(self.py(), &e, None))?;
        Ok(options)
    }

    fn size(&self) -> PyResult<Option<Size>> {
        let hexes = self.whole::<usize>("hexes")?.map(Size::Hexes);
        let length = self.take("edge_length")?.map(Size::EdgeLength);
        let scale = self.take("scale")?.map(Size::Scale);
        let mut given = [hexes, length, scale].into_iter().flatten();
        let size = given.next();
        match given.next() {
            None => Ok(size),
            Some(_) => {
                let message = "hexes, edge_length and scale contradict each other";
                Err(errors::option(self.py(), message, "give one of them"))
            }
        }
    }
}
