//! Registers every constraint of the library in a registry.

use super::Registry;
use crate::forces::library;
use crate::joints::{drivers, planar, spatial};

/// Returns the registry with all of them.
pub(crate) fn registered(registry: Registry) -> Registry {
    let registry = registered_planar(registry);
    let registry = registered_drivers(registry);
    let registry = registered_spatial(registry);
    registered_loads(registry)
}

/// Registers energies, forces, and the lengths and angles along which they act.
fn registered_loads(registry: Registry) -> Registry {
    registry
        .with::<library::length>()
        .with::<library::turn>()
        .with::<library::slide>()
        .with::<library::along>()
        .with::<library::spring>()
        .with::<library::torsion_spring>()
        .with::<library::coordinate_spring>()
        .with::<library::bushing>()
        .with::<library::spring_damper>()
        .with::<library::viscous>()
        .with::<library::force_by>()
        .with::<library::force_in_time>()
        .with::<library::pressure>()
        .with::<library::gas>()
        .with::<library::spatial::length>()
        .with::<library::spatial::slide>()
        .with::<library::spatial::turn>()
        .with::<library::spatial::small_turn>()
        .with::<library::spatial::spring>()
        .with::<library::spatial::torsion_spring>()
        .with::<library::spatial::bushing>()
}

fn registered_planar(registry: Registry) -> Registry {
    registry
        .with::<planar::gear>()
        .with::<planar::internal_gear>()
        .with::<planar::belt>()
        .with::<planar::rack_and_pinion>()
        .with::<planar::rolling>()
        .with::<planar::coupling>()
        .with::<planar::linear_coupling>()
        .with::<planar::point_on_curve>()
        .with::<planar::cam_knife_edge>()
        .with::<planar::cam_flat_face>()
        .with::<planar::cam_roller>()
        .with::<planar::moving_point>()
        .with::<planar::point_on_path>()
        .with::<planar::fixed>()
        .with::<planar::revolute>()
        .with::<planar::weld>()
        .with::<planar::distance>()
        .with::<planar::angle>()
        .with::<planar::parallel>()
        .with::<planar::prismatic>()
        .with::<planar::point_on_line>()
        .with::<planar::pin_in_slot>()
        .with::<planar::point_on_circle>()
}

fn registered_drivers(registry: Registry) -> Registry {
    registry
        .with::<drivers::drive>()
        .with::<drivers::drive_angle>()
        .with::<drivers::drive_relative_angle>()
        .with::<drivers::drive_slide>()
        .with::<drivers::drive_distance>()
        .with::<drivers::drive_point>()
        .with::<drivers::drive_point_along>()
        .with::<drivers::spatial::drive_turn>()
        .with::<drivers::spatial::drive_slide>()
        .with::<drivers::spatial::drive_distance>()
        .with::<drivers::spatial::drive_point>()
        .with::<drivers::spatial::drive_point_along>()
        .with::<drivers::spatial::drive_rotation>()
        .with::<drivers::spatial::drive_orientation>()
        .with::<drivers::spatial::drive_motion>()
}

fn registered_spatial(registry: Registry) -> Registry {
    registry
        .with::<spatial::relative_angle>()
        .with::<spatial::gear>()
        .with::<spatial::gear_by_radii>()
        .with::<spatial::thread>()
        .with::<spatial::rack_and_pinion>()
        .with::<spatial::parallel>()
        .with::<spatial::perpendicular>()
        .with::<spatial::angle>()
        .with::<spatial::revolute_spherical>()
        .with::<spatial::revolute_revolute>()
        .with::<spatial::revolute_cylindrical>()
        .with::<spatial::spherical_cylindrical>()
        .with::<spatial::fixed>()
        .with::<spatial::weld>()
        .with::<spatial::revolute>()
        .with::<spatial::prismatic>()
        .with::<spatial::cylindrical>()
        .with::<spatial::universal>()
        .with::<spatial::planar>()
        .with::<spatial::screw>()
        .with::<spatial::constant_velocity>()
        .with::<spatial::moving_point>()
        .with::<spatial::point_on_path>()
        .with::<spatial::euler_norm>()
        .with::<spatial::held_turn>()
        .with::<spatial::spherical>()
        .with::<spatial::distance>()
        .with::<spatial::point_on_line>()
        .with::<spatial::point_in_plane>()
        .with::<spatial::point_coordinate>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Collects the names of all functions with `#[constraint]`, `#[potential]` and `#[force]` in a
    /// file, or in the files of a folder.
    fn written(path: &std::path::Path, names: &mut Vec<String>) {
        if let Ok(text) = std::fs::read_to_string(path) {
            for mark in ["\n#[constraint", "\n#[potential]", "\n#[force]"] {
                let name = |text: &str| {
                    Some(text.split_once("\npub fn ")?.1.split_once('(')?.0.to_string())
                };
                names.extend(text.split(mark).skip(1).filter_map(name));
            }
            return;
        }
        std::fs::read_dir(path).unwrap().for_each(|entry| written(&entry.unwrap().path(), names));
    }

    #[test]
    fn every_constraint_of_the_library_is_registered() {
        let mut names = Vec::new();
        let sources = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        ["joints", "forces/library.rs", "forces/library"]
            .iter()
            .for_each(|part| written(&sources.join(part), &mut names));
        names.sort();
        let registry = Registry::new();
        let mut registered: Vec<&str> =
            registry.kinds().into_iter().map(|(kind, _)| kind).collect();
        registered.sort();
        assert!(names.len() > 30, "{names:?}");
        assert_eq!(registered, names);
    }
}
