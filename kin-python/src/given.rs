//! Bodies, numbers and equations as Python gives them, as those of a mechanism.

use kin::text::{Making, On, Parameter};
use kin::{Dimension, Ground};
use pyo3::prelude::*;

use crate::equation::{Equation, Given, Number};
use crate::fault::{or_raise, unreadable, wrong_type};
use crate::mechanism::{Mechanism, Place};

impl Mechanism {
    pub(crate) fn coordinate(&self, name: &str) -> PyResult<kin::Coordinate> {
        self.0.coordinate_named(name).ok_or_else(|| unknown(name))
    }

    pub(crate) fn on(&self, (kind, name): &Place) -> PyResult<On> {
        let Some(name) = name else { return Ok(On::from(Ground)) };
        Ok(match kind.as_str() {
            "planar" => self.0.planar_named(name).ok_or_else(|| unknown(name))?.into(),
            "spatial" => self.0.spatial_named(name).ok_or_else(|| unknown(name))?.into(),
            "coord" => self.coordinate(name)?.into(),
            "ground_coord" => ground_coordinate(name)?.into(),
            _ => return Err(wrong_type(format!("`{kind}` is no kind of a body or coordinate"))),
        })
    }

    pub(crate) fn number(&self, py: Python<'_>, number: Number) -> PyResult<Dimension> {
        match number {
            Number::Plain(x) => Ok(x.into()),
            Number::Expression(text) => or_raise(py, self.0.expression(&text)),
        }
    }

    pub(crate) fn numbers(&self, py: Python<'_>, all: Vec<Number>) -> PyResult<Vec<Dimension>> {
        all.into_iter().map(|number| self.number(py, number)).collect()
    }

    pub(crate) fn parameter(&self, py: Python<'_>, given: Given) -> PyResult<Parameter> {
        match given {
            Given::Law(json) => {
                let data = serde_json::from_str(&json).map_err(|error| unreadable(&error))?;
                or_raise(py, self.0.law(&data, &kin::text::registry())).map(Parameter::Law)
            }
            Given::Numbers(numbers) => self.numbers(py, numbers).map(Parameter::Numbers),
        }
    }

    pub(crate) fn making(
        &self,
        py: Python<'_>,
        equation: &Bound<'_, Equation>,
        on: Vec<Place>,
        parameters: Vec<(String, Given)>,
    ) -> PyResult<Making> {
        let on = on.iter().map(|place| self.on(place)).collect::<PyResult<Vec<On>>>()?;
        let mut on = on.into_iter();
        let first =
            on.next().ok_or_else(|| wrong_type("an equation needs a body or coordinate"))?;
        let making = on.fold(equation.get().0.on(first), Making::on);
        parameters.into_iter().try_fold(making, |making, (name, value)| {
            Ok(making.with(&name, self.parameter(py, value)?))
        })
    }
}

/// One of the ground's coordinates as a planar body, by its number.
fn ground_coordinate(number: &str) -> PyResult<kin::Coordinate> {
    let ground = kin::PlanarBody::from(Ground);
    Ok(match number {
        "0" => ground.x(),
        "1" => ground.y(),
        "2" => ground.theta(),
        _ => return Err(unknown(number)),
    })
}

/// The error for a name that nothing of that kind has.
pub(crate) fn unknown(name: &str) -> PyErr {
    wrong_type(format!("there is no `{name}` of that kind in this mechanism"))
}
