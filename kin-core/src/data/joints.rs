//! Every constraint of the library, for registries.

use super::Registry;
use crate::joints::{drivers, planar, spatial};

/// The registry with all of them.
pub(crate) fn registered(registry: Registry) -> Registry {
    let registry = registered_planar(registry);
    let registry = registered_drivers(registry);
    registered_spatial(registry)
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

    /// The names of all functions under `#[constraint]` in the files of this folder.
    fn written(folder: &std::path::Path, names: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                written(&path, names);
            } else {
                let text = std::fs::read_to_string(&path).unwrap();
                let constraints = text.split("\n#[constraint").skip(1);
                names.extend(
                    constraints.filter_map(|text| {
                        Some(text.split_once("\npub fn ")?.1.split_once('(')?.0.to_string())
                    }),
                );
            }
        }
    }

    #[test]
    fn every_constraint_of_the_library_is_registered() {
        let mut names = Vec::new();
        written(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/joints"), &mut names);
        names.sort();
        let registry = Registry::new();
        let mut registered: Vec<&str> = registry.kinds().into_iter().map(|(kind, _)| kind).collect();
        registered.sort();
        assert!(names.len() > 30, "{names:?}");
        assert_eq!(registered, names);
    }
}
