//! Defines how redundant constraints share forces.

/// The rule by which redundant constraints share a force that the equations of equilibrium do not
/// determine.
///
/// ```
/// # use kin::prelude::*;
/// use kin::forces::LoadSharing;
/// use kin::SolverOptions;
/// # fn main() -> kin::Result<()> {
/// let mut m = Mechanism::new("door");
/// let door = m.spatial("door", SpatialPose::at(vec3(0.5, 0.0, 1.0)))?;
/// let (ground, z) = (m.ground(), vec3(0.0, 0.0, 1.0));
/// for (name, height) in [("hinge 1", 0.3), ("hinge 2", 1.7)] {
///     let (u, p) = (vec3(-0.5, 0.0, height - 1.0), vec3(0.0, 0.0, height));
///     m.add(name, spatial::revolute(door, ground, u, p, z, z))?;
/// }
/// m.add("hand", spatial::drive_turn(door, ground, z, z, Law::ramp(0.5)))?;
/// m.mass(door, 20.0, vec3(0.0, 0.0, 0.0), [[8.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 2.0]])?;
/// m.gravity(vec3(0.0, 0.0, -9.81));
/// let system = m.build()?;
/// let motion = system.run([0.0, 0.5])?;
///
/// let forces = system.forces(&motion)?;
/// // Which hinge carries the door?
/// assert!(forces.reaction("hinge 1")?.on(door)?.component("F_z").is_err());
/// let both = forces.sum(["hinge 1", "hinge 2"])?.on(door)?.component("F_z")?;
/// assert!((both.max() - 196.2).abs() < 1e-9);
///
/// let options = SolverOptions::new().sharing(LoadSharing::LeastNorm);
/// let forces = system.solver().options(options).forces(&motion)?;
/// assert!((forces.reaction("hinge 1")?.on(door)?.component("F_z")?.max() - 98.1).abs() < 1e-9);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LoadSharing {
    /// Kin returns no number for a force that is not unique.
    #[default]
    NotGiven,
    /// Kin minimises the sum of the squares of the forces and torques of all constraints, each
    /// torque about the point of its constraint. In this sum one unit of force counts like one unit
    /// of torque, such as 1 N and 1 N m.
    LeastNorm,
    /// The named equations, such as `hinge 2.z`, carry no force. The list must have as many
    /// equations as are redundant, and the other equations must be independent.
    Without(Vec<String>),
}
