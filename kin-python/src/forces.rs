//! Forces of a motion.

use kin::SolverOptions;
use kin::forces::{BodyWrench, LoadSharing};
use kin::loads::HasTorque;
use kin::loads::{HasMass, Solid};
use kin::results::Series;
use kin::{EulerParameters, Ground, Mat3, PlanarBody, SpatialBody};
use kin::{Vec2, Vec3};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::fault::{or_raise, value, wrong_type};
use crate::held::HeldForces;
use crate::motion::{Motion, Orders, series};
use crate::numbers::{self, vec2, vec3};
use crate::options::engine_named;
use crate::system::System;

/// The forces of a motion of a system.
#[pyclass(frozen, module = "kin._native")]
pub struct Forces(HeldForces);

/// A way to another point or other axes: `at`, `about` or `in_body`, with a point for the first
/// two.
type Way = (String, Vec<f64>);

/// Sources of forces on bodies: `constraints` by their names, of which none are all that act on the
/// ground, a `load`, or the `friction` of a joint.
type Sources = (String, Vec<String>);

/// A body: true in the plane; its name, none of the ground.
type OnBody = (bool, Option<String>);

/// A drive: its name, its efforts row by row, its power, its peak (value, time, unit), that in
/// words.
type Driven<'py> = (String, Vec<Orders<'py>>, Orders<'py>, (f64, f64, String), String);

/// Energies T and V; powers of drives and loads, rate of T, what is left; the largest power, the
/// share that is left, that in words.
type Balanced<'py> = (Vec<Orders<'py>>, Vec<Orders<'py>>, f64, f64, String);

impl Forces {
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&kin::forces::Forces<'_>) -> kin::Result<T> + Send,
    ) -> PyResult<T> {
        or_raise(py, py.detach(|| ask(self.0.borrow_dependent())))
    }
}

impl Forces {
    /// The forces themselves.
    pub fn forces(&self) -> &kin::forces::Forces<'_> {
        self.0.borrow_dependent()
    }
}

#[pymethods]
impl Forces {
    #[new]
    #[pyo3(signature = (system, motion, engine, least_norm, left_out = None))]
    fn new(
        py: Python<'_>,
        system: &System,
        motion: &Motion,
        engine: &str,
        least_norm: bool,
        left_out: Option<Vec<String>>,
    ) -> PyResult<Forces> {
        let engine = engine_named(engine)?;
        let sharing = match left_out {
            Some(names) => LoadSharing::Without(names),
            None if least_norm => LoadSharing::LeastNorm,
            None => LoadSharing::default(),
        };
        let options = SolverOptions::new().engine(engine).sharing(sharing);
        let run = (system.now(), motion.0.clone());
        let found = py.detach(|| {
            HeldForces::try_new(run, |(system, motion)| {
                system.solver().options(options).forces(motion)
            })
        });
        or_raise(py, found).map(Forces)
    }

    /// How many times a program has computed, and how many of those it has handed back.
    fn engine(&self, py: Python<'_>) -> PyResult<(usize, usize)> {
        self.with(py, |forces| Ok((forces.engine().compiled, forces.engine().handed_back)))
    }

    fn why_not_compiled(&self, py: Python<'_>) -> PyResult<Option<String>> {
        self.with(py, |forces| Ok(forces.why_not_compiled().map(str::to_owned)))
    }

    /// Raises an error by name unless these are there.
    fn check(&self, py: Python<'_>, sources: Sources) -> PyResult<()> {
        self.with(py, |forces| reaction(forces, &sources).map(drop))
    }

    fn balance<'py>(&self, py: Python<'py>) -> PyResult<Balanced<'py>> {
        let (energy, balance) =
            self.with(py, |forces| Ok((forces.energy().clone(), forces.balance().clone())))?;
        let all = |list: [&Series; 2]| {
            list.into_iter().map(|one| series(py, one)).collect::<PyResult<_>>()
        };
        let mut powers: Vec<Orders<'py>> = all([&balance.drives, &balance.loads])?;
        powers.extend(all([&balance.kinetic, &balance.left])?);
        let share = balance.worst();
        let words = balance.to_string();
        Ok((all([&energy.kinetic, &energy.potential])?, powers, balance.largest, share, words))
    }

    fn drives(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |forces| Ok(forces.drives().into_iter().map(str::to_owned).collect()))
    }

    fn drive<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Driven<'py>> {
        let drive = self.with(py, |forces| forces.drive(name))?;
        let efforts = drive.efforts().iter().map(|one| series(py, one)).collect::<PyResult<_>>()?;
        let peak = drive.peak();
        let words = peak.to_string();
        Ok((
            name.to_owned(),
            efforts,
            series(py, drive.power())?,
            (peak.value, peak.t, peak.unit),
            words,
        ))
    }

    /// Power of a constraint, of several together, of a load.
    fn power<'py>(&self, py: Python<'py>, sources: Sources) -> PyResult<Orders<'py>> {
        let power =
            self.with(py, |forces| reaction(forces, &sources).map(|found| found.power()))?;
        series(py, &power)
    }

    /// Something that is asked of the force and torque of constraints or a load on a body, over
    /// time.
    fn acted<'py>(
        &self,
        py: Python<'py>,
        sources: Sources,
        body: OnBody,
        ways: Vec<Way>,
        asked: &str,
    ) -> PyResult<Vec<Orders<'py>>> {
        let found = match self.body(body, ways)? {
            Moved::InPlane(body, ways) => {
                self.with(py, |forces| ask(&on(forces, &sources, body, ways)?, asked))?
            }
            Moved::InSpace(body, ways) => {
                self.with(py, |forces| ask(&on(forces, &sources, body, ways)?, asked))?
            }
        };
        found.iter().map(|one| series(py, one)).collect()
    }

    /// The points about which that torque is, row by row, and the components that are not unique.
    fn points<'py>(
        &self,
        py: Python<'py>,
        sources: Sources,
        body: OnBody,
        ways: Vec<Way>,
    ) -> PyResult<(Bound<'py, PyBytes>, Vec<&'static str>)> {
        let (points, components) = match self.body(body, ways)? {
            Moved::InPlane(body, ways) => self.with(py, |forces| {
                let acted = on(forces, &sources, body, ways)?;
                let points = acted.points().iter().flat_map(|v| v.to_array()).collect::<Vec<f64>>();
                Ok((points, acted.not_unique()))
            }),
            Moved::InSpace(body, ways) => self.with(py, |forces| {
                let acted = on(forces, &sources, body, ways)?;
                let points = acted.points().iter().flat_map(|v| v.to_array()).collect::<Vec<f64>>();
                Ok((points, acted.not_unique()))
            }),
        }?;
        Ok((numbers::list(py, &points)?, components))
    }

    /// The constraints whose forces grow without bound: name, t*, the power of |t − t*|, that in
    /// words.
    fn growth(&self, py: Python<'_>) -> PyResult<Vec<(String, f64, f64, String)>> {
        let found = self.with(py, |forces| forces.growth())?;
        let told = found
            .into_iter()
            .map(|one| (one.constraint.clone(), one.t, one.power, one.to_string()));
        Ok(told.collect())
    }

    /// All that is unique, as columns.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Vec<Orders<'py>>> {
        let found = self.with(py, |forces| Ok(forces.columns()))?;
        found.iter().map(|one| series(py, one)).collect()
    }

    /// The column of this name.
    fn named<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Orders<'py>> {
        series(py, &self.with(py, |forces| forces.named(name))?)
    }

    fn write_csv(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        self.with(py, |forces| forces.write_csv(path))
    }
}

/// A body of the plane or of space, and the ways to another point or other axes.
enum Moved {
    InPlane(PlanarBody, Vec<(String, Option<Vec2>)>),
    InSpace(SpatialBody, Vec<(String, Option<Vec3>)>),
}

impl Forces {
    /// The body of this name, the ground where there is none. Errors: another one, points of
    /// another size.
    fn body(&self, (in_plane, name): OnBody, ways: Vec<Way>) -> PyResult<Moved> {
        let find = |name: &str| {
            wrong_type(format!("there is no body `{name}` of that kind in this mechanism"))
        };
        let motion = &self.0.borrow_owner().1;
        if in_plane {
            let body = name.map_or(Ok(PlanarBody::from(Ground)), |name| {
                motion.planar_named(&name).ok_or_else(|| find(&name))
            });
            let ways = ways.into_iter().map(|(way, u)| Ok((way, of_two(u)?)));
            return Ok(Moved::InPlane(body?, ways.collect::<PyResult<_>>()?));
        }
        let body = name.map_or(Ok(SpatialBody::from(Ground)), |name| {
            motion.spatial_named(&name).ok_or_else(|| find(&name))
        });
        let ways = ways.into_iter().map(|(way, u)| Ok((way, of_three(u)?)));
        Ok(Moved::InSpace(body?, ways.collect::<PyResult<_>>()?))
    }
}

fn reaction<'f>(
    forces: &'f kin::forces::Forces<'f>,
    (kind, names): &Sources,
) -> kin::Result<kin::forces::Reaction<'f>> {
    match (kind.as_str(), &names[..]) {
        ("load", [name]) => forces.load(name),
        ("friction", [name]) => forces.friction(name),
        (_, []) => Ok(forces.on_ground()),
        (_, [name]) => forces.reaction(name),
        (_, names) => forces.sum(names),
    }
}

fn on<'f, B: HasMass>(
    forces: &'f kin::forces::Forces<'f>,
    sources: &Sources,
    body: B,
    ways: Vec<(String, Option<B::Vector>)>,
) -> kin::Result<BodyWrench<'f, B::Vector>>
where
    B::Vector: HasTorque,
{
    let acted = reaction(forces, sources)?.on(body)?;
    let moved = |acted: BodyWrench<'f, B::Vector>, (way, point): (String, Option<B::Vector>)| match (
        way.as_str(),
        point,
    ) {
        ("at", Some(u)) => acted.at(u),
        ("about", Some(point)) => acted.about(point),
        _ => acted.in_body(),
    };
    Ok(ways.into_iter().fold(acted, moved))
}

fn ask<V: HasTorque>(acted: &BodyWrench<'_, V>, asked: &str) -> kin::Result<Vec<Series>> {
    match asked {
        "components" => Ok(acted.components()),
        "magnitude" => acted.magnitude().map(|one| vec![one]),
        "torque_magnitude" => acted.torque_magnitude().map(|one| vec![one]),
        names => names.split_whitespace().map(|name| acted.component(name)).collect(),
    }
}

fn of_two(u: Vec<f64>) -> PyResult<Option<Vec2>> {
    match u[..] {
        [] => Ok(None),
        [x, y] => Ok(Some(vec2([x, y]))),
        _ => Err(wrong_type("a point of a planar body has two numbers")),
    }
}

fn of_three(u: Vec<f64>) -> PyResult<Option<Vec3>> {
    match u[..] {
        [] => Ok(None),
        [x, y, z] => Ok(Some(vec3([x, y, z]))),
        _ => Err(wrong_type("a point of a spatial body has three numbers")),
    }
}

/// Mass, centre and inertia.
pub type Mass = (f64, [f64; 3], [[f64; 3]; 3]);

pub fn solid((mass, centre, inertia): Mass) -> Solid {
    Solid { mass, centre: vec3(centre), inertia: Mat3::from(inertia) }
}

fn mass(solid: Solid) -> Mass {
    (solid.mass, solid.centre.to_array(), solid.inertia.to_array())
}

/// A shape of these sizes with a density.
#[pyfunction]
pub fn solid_of(shape: &str, sizes: Vec<f64>, density: f64) -> PyResult<Mass> {
    Ok(mass(match (shape, &sizes[..]) {
        ("cuboid", &[a, b, c]) => Solid::cuboid(a, b, c, density),
        ("cylinder", &[radius, length]) => Solid::cylinder(radius, length, density),
        ("disc", &[radius, thickness]) => Solid::disc(radius, thickness, density),
        ("sphere", &[radius]) => Solid::sphere(radius, density),
        ("plate", [thickness, corners @ ..]) if corners.len() >= 6 && corners.len() % 2 == 0 => {
            let corners: Vec<Vec2> =
                corners.chunks_exact(2).map(|c| Vec2::new(c[0], c[1])).collect();
            Solid::plate(&corners, *thickness, density)
        }
        _ => return Err(value(format!("`{shape}` does not have these sizes: {sizes:?}"))),
    }))
}

/// A solid turned about the body's origin.
#[pyfunction]
pub fn solid_turned(of: Mass, p: [f64; 4]) -> Mass {
    let [e0, e1, e2, e3] = p;
    mass(solid(of).turned(EulerParameters::new(e0, e1, e2, e3)))
}

/// Two solids as one, or the first without the second.
#[pyfunction]
pub fn solid_joined(first: Mass, second: Mass, cut: bool) -> Mass {
    let first = solid(first);
    let second = solid(second);
    mass(if cut { first.without(second) } else { first.and(second) })
}
