//! A mechanism as it is described. Bodies and coordinates are told by their names; `kin.Mechanism`
//! sees that they are its own.

use kin::data::{ConstraintData, LoadData, MechanismData};
use kin::loads::Friction;
use kin::text::On;
use kin::{Dimension, Ground, Pose, SpatialPose};
use pyo3::prelude::*;

use crate::design::distribution_of;
use crate::equation::{Equation, Given, Number, Terms, terms};
use crate::fault::{or_raise, unreadable, wrong_type};
use crate::forces::{Mass, solid};
use crate::given::unknown;
use crate::numbers::{vec2, vec3};
use crate::system::{System, Verdict};

/// A mechanism.
#[pyclass(module = "kin._native")]
pub struct Mechanism(pub(crate) kin::Mechanism);

/// A body or coordinate: its kind and its name; the ground has none.
pub(crate) type Place = (String, Option<String>);

#[pymethods]
impl Mechanism {
    #[new]
    fn new(name: &str) -> Mechanism {
        Mechanism(kin::Mechanism::new(name))
    }

    #[staticmethod]
    fn from_json(py: Python<'_>, text: &str) -> PyResult<Mechanism> {
        let data = or_raise(py, MechanismData::read(text))?;
        let made = py.detach(|| kin::Mechanism::from_data(&data, &kin::text::registry()));
        or_raise(py, made).map(Mechanism)
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        serde_json::to_string(&or_raise(py, self.0.data())?).map_err(|error| unreadable(&error))
    }

    fn write_json(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        or_raise(py, self.0.write_json(path))
    }

    fn name(&self) -> &str {
        self.0.name()
    }

    fn units(&mut self, length: &str, time: &str, mass: Option<&str>) {
        let words = self.0.units(length, time);
        if let Some(mass) = mass {
            words.mass(mass);
        }
    }

    /// Gives a body its mass, centre and inertia.
    fn solid(&mut self, py: Python<'_>, place: Place, given: Mass) -> PyResult<()> {
        let done = match self.on(&place)? {
            On::Planar(body) => self.0.solid(body, solid(given)),
            On::Spatial(body) => self.0.solid(body, solid(given)),
            _ => self.0.solid(kin::PlanarBody::from(Ground), solid(given)),
        };
        or_raise(py, done)
    }

    /// The same by numbers that may hang on dimensions: the mass, the centre, the inertia by rows.
    fn mass(&mut self, py: Python<'_>, place: Place, given: Vec<Number>) -> PyResult<()> {
        let given = self.numbers(py, given)?;
        let [mass, x, y, z, j @ ..] = &given[..] else {
            return Err(wrong_type("a mass has 13 numbers"));
        };
        let (Some((rows, _)), (m, x, y, z)) = (j.split_first_chunk::<9>(), (*mass, *x, *y, *z))
        else {
            return Err(wrong_type("an inertia has nine numbers"));
        };
        let [a, b, c, d, e, f, g, h, i] = *rows;
        let done = match self.on(&place)? {
            On::Spatial(body) => self.0.mass(body, m, [x, y, z], [[a, b, c], [d, e, f], [g, h, i]]),
            On::Planar(body) => self.0.mass(body, m, [x, y], i),
            _ => self.0.mass(kin::PlanarBody::from(Ground), m, [x, y], i),
        };
        or_raise(py, done)
    }

    /// Gives a point, which an equation says, its mass.
    fn point_mass(
        &mut self,
        py: Python<'_>,
        name: &str,
        equation: &Bound<'_, Equation>,
        on: Vec<Place>,
        parameters: Vec<(String, Given)>,
        mass: Number,
    ) -> PyResult<()> {
        let mass = self.number(py, mass)?;
        let point = or_raise(py, self.making(py, equation, on, parameters)?.constraint())?;
        or_raise(py, self.0.point_mass(name, point, mass))
    }

    /// Gives a joint friction: of a pin with its radius and the length of its bearing, or of a
    /// slide with length and width of its guide.
    fn friction(
        &mut self,
        py: Python<'_>,
        joint: &str,
        pin: bool,
        coefficient: Number,
        sizes: (Number, Number),
        rate: Number,
    ) -> PyResult<()> {
        let [coefficient, rate] = [self.number(py, coefficient)?, self.number(py, rate)?];
        let sizes = [self.number(py, sizes.0)?, self.number(py, sizes.1)?];
        let friction = match pin {
            true => Friction::pin(coefficient, sizes[0], rate).length(sizes[1]),
            false => Friction::slide(coefficient, sizes, rate),
        };
        or_raise(py, self.0.friction(joint, friction))
    }

    fn gravity(&mut self, py: Python<'_>, g: Vec<Number>) -> PyResult<()> {
        match self.numbers(py, g)?[..] {
            [x, y, z] => self.0.gravity(kin::Vec3::from([x, y, z])),
            _ => return Err(wrong_type("gravity has three components")),
        }
        Ok(())
    }

    /// Adds a load, described as in a file, with the texts of the functions that it names.
    fn load(&mut self, py: Python<'_>, json: &str, equations: Vec<String>) -> PyResult<()> {
        let data: LoadData = serde_json::from_str(json).map_err(|error| unreadable(&error))?;
        let registry = kin::text::registry().with_equations(&equations).map_err(wrong_type)?;
        or_raise(py, self.0.add_load_data(&data, &registry))
    }

    /// A dimension, or a name for an expression of others; gives its value.
    #[expect(clippy::too_many_arguments, reason = "the arguments of the Python method around it")]
    fn dimension(
        &mut self,
        py: Python<'_>,
        name: &str,
        value: Number,
        unit: &str,
        within: Option<[f64; 2]>,
        tolerance: Option<f64>,
        distribution: Option<&str>,
    ) -> PyResult<f64> {
        let distribution = distribution.map(distribution_of).transpose()?;
        let value = self.number(py, value)?;
        let mut made = or_raise(py, self.0.dimension(name, value))?;
        if let Some([from, to]) = within {
            made = made.within(from, to);
        }
        if let Some(tolerance) = tolerance {
            made = made.tolerance(tolerance);
        }
        if let Some(distribution) = distribution {
            made = made.distributed(distribution);
        }
        if !unit.is_empty() {
            made = made.unit(unit);
        }
        Ok(made.value())
    }

    /// The clearance of a joint: the dimensions `NAME.x` and `NAME.y`.
    fn clearance(&mut self, py: Python<'_>, name: &str, radius: f64) -> PyResult<()> {
        or_raise(py, self.0.clearance(name, radius)).map(drop)
    }

    /// The value of an expression of dimensions.
    fn expression(&self, py: Python<'_>, text: &str) -> PyResult<f64> {
        or_raise(py, self.0.expression(text)).map(Dimension::value)
    }

    fn link(&mut self, py: Python<'_>, name: &str, length: Number) -> PyResult<f64> {
        let length = self.number(py, length)?;
        or_raise(py, self.0.link(name, length)).map(|link| link.length().value())
    }

    fn link_between(
        &mut self,
        py: Python<'_>,
        name: &str,
        a: [f64; 2],
        b: [f64; 2],
    ) -> PyResult<f64> {
        or_raise(py, self.0.link_between(name, vec2(a), vec2(b))).map(|link| link.length())
    }

    fn planar(
        &mut self,
        py: Python<'_>,
        name: &str,
        pose: (Number, Number, Number),
    ) -> PyResult<()> {
        let x = self.number(py, pose.0)?;
        let y = self.number(py, pose.1)?;
        let theta = self.number(py, pose.2)?;
        or_raise(py, self.0.planar(name, Pose { x, y, theta })).map(|_| ())
    }

    fn spatial(&mut self, py: Python<'_>, name: &str, pose: [f64; 7]) -> PyResult<()> {
        or_raise(py, self.0.spatial(name, spatial_pose(pose))).map(|_| ())
    }

    fn spatial_link_between(
        &mut self,
        py: Python<'_>,
        name: &str,
        a: [f64; 3],
        b: [f64; 3],
    ) -> PyResult<f64> {
        or_raise(py, self.0.spatial_link_between(name, vec3(a), vec3(b))).map(|link| link.length())
    }

    fn angle(&mut self, py: Python<'_>, name: &str, guess: Number) -> PyResult<()> {
        let guess = self.number(py, guess)?;
        or_raise(py, self.0.angle(name, guess)).map(|_| ())
    }

    fn length(&mut self, py: Python<'_>, name: &str, guess: Number) -> PyResult<()> {
        let guess = self.number(py, guess)?;
        or_raise(py, self.0.length(name, guess)).map(|_| ())
    }

    /// Adds a constraint of the library, described as in a file.
    fn add(&mut self, py: Python<'_>, json: &str) -> PyResult<()> {
        let data: ConstraintData =
            serde_json::from_str(json).map_err(|error| unreadable(&error))?;
        or_raise(py, self.0.add_data(&data, &kin::text::registry())).map(|_| ())
    }

    /// Adds a constraint of an equation.
    fn add_equation(
        &mut self,
        py: Python<'_>,
        name: &str,
        equation: &Bound<'_, Equation>,
        on: Vec<Place>,
        parameters: Vec<(String, Given)>,
    ) -> PyResult<()> {
        let making = self.making(py, equation, on, parameters)?;
        let constraint = or_raise(py, making.constraint())?;
        or_raise(py, self.0.add(name, constraint)).map(|_| ())
    }

    /// Every term of such a constraint where its own coordinates, their rates and the time are
    /// these.
    #[expect(clippy::too_many_arguments, reason = "one argument for each that the equation has")]
    fn terms<'py>(
        &self,
        py: Python<'py>,
        equation: &Bound<'_, Equation>,
        on: Vec<Place>,
        parameters: Vec<(String, Given)>,
        q: &[u8],
        qd: &[u8],
        t: f64,
    ) -> PyResult<Terms<'py>> {
        let constraint = or_raise(py, self.making(py, equation, on, parameters)?.constraint())?;
        terms(&constraint, q, qd, t)
    }

    fn set_guess(&mut self, py: Python<'_>, coordinate: &str, value: f64) -> PyResult<()> {
        let place = self.coordinate(coordinate)?;
        or_raise(py, self.0.guess(place, value))
    }

    fn set_initial(&mut self, py: Python<'_>, q: Vec<f64>) -> PyResult<()> {
        or_raise(py, self.0.set_initial(&q))
    }

    fn set_pose(&mut self, py: Python<'_>, body: &str, pose: [f64; 3]) -> PyResult<()> {
        let body = self.0.planar_named(body).ok_or_else(|| unknown(body))?;
        or_raise(py, self.0.set_pose(body, planar_pose(pose)))
    }

    fn set_spatial_pose(&mut self, py: Python<'_>, body: &str, pose: [f64; 7]) -> PyResult<()> {
        let body = self.0.spatial_named(body).ok_or_else(|| unknown(body))?;
        or_raise(py, self.0.set_spatial_pose(body, spatial_pose(pose)))
    }

    /// Prefers a coordinate, or a measure of a joint, near a value.
    fn prefer(&mut self, py: Python<'_>, what: &str, value: Number) -> PyResult<()> {
        let value = self.number(py, value)?;
        match self.0.coordinate_named(what) {
            Some(coordinate) => self.0.prefer(coordinate, value),
            None => self.0.prefer(what, value),
        }
        Ok(())
    }

    fn prefer_turn(&mut self, py: Python<'_>, body: &str, p: Vec<Number>) -> PyResult<()> {
        let p = self.numbers(py, p)?;
        let body = self.0.spatial_named(body).ok_or_else(|| unknown(body))?;
        let [e0, e1, e2, e3] = p[..] else {
            return Err(wrong_type("there are four Euler parameters"));
        };
        self.0.prefer(body, kin::EulerParameters { e0, e1, e2, e3 });
        Ok(())
    }

    fn prefer_pose(&mut self, body: &str, pose: [f64; 7]) -> PyResult<()> {
        let body = self.0.spatial_named(body).ok_or_else(|| unknown(body))?;
        self.0.prefer(body, spatial_pose(pose));
        Ok(())
    }

    fn limit(&mut self, py: Python<'_>, measure: &str, from: f64, to: f64) -> PyResult<()> {
        or_raise(py, self.0.limit(measure, from, to))
    }

    /// A global point, or direction, as a body sees it where it is drawn.
    fn local(
        &self,
        py: Python<'_>,
        place: Place,
        vector: Vec<f64>,
        point: bool,
    ) -> PyResult<Vec<f64>> {
        let planar = |body: kin::PlanarBody, v| match point {
            true => self.0.local(body, vec2(v)),
            false => self.0.local_direction(body, vec2(v)),
        };
        let spatial = |body: kin::SpatialBody, v| match point {
            true => self.0.local(body, vec3(v)),
            false => self.0.local_direction(body, vec3(v)),
        };
        match (self.on(&place)?, &vector[..]) {
            (On::Planar(body), &[x, y]) => {
                or_raise(py, planar(body, [x, y])).map(|v| v.to_array().to_vec())
            }
            (On::Spatial(body), &[x, y, z]) => {
                or_raise(py, spatial(body, [x, y, z])).map(|v| v.to_array().to_vec())
            }
            (On::Ground, _) => Ok(vector),
            _ => {
                Err(wrong_type("a point of a planar body has two numbers, of a spatial one three"))
            }
        }
    }

    fn hold_idle_turns(&mut self, py: Python<'_>) -> PyResult<Vec<String>> {
        or_raise(py, self.0.hold_idle_turns())
    }

    fn build(&self, py: Python<'_>) -> PyResult<System> {
        let mechanism = self.0.clone();
        or_raise(py, py.detach(|| mechanism.build())).map(System::from)
    }

    /// The diagnosis: as text, as JSON, and what follows of it.
    #[pyo3(signature = (t, q = None))]
    fn diagnose(&self, py: Python<'_>, t: f64, q: Option<Vec<f64>>) -> PyResult<Verdict> {
        let mechanism = &self.0;
        let found = py.detach(|| match q {
            Some(q) => mechanism.diagnose((t, &q)),
            None => mechanism.diagnose(t),
        });
        crate::system::diagnosis(&or_raise(py, found)?)
    }
}

fn planar_pose([x, y, theta]: [f64; 3]) -> Pose {
    Pose { x, y, theta }
}

fn spatial_pose([x, y, z, e0, e1, e2, e3]: [f64; 7]) -> SpatialPose {
    SpatialPose::new(vec3([x, y, z]), kin::EulerParameters::new(e0, e1, e2, e3))
}
