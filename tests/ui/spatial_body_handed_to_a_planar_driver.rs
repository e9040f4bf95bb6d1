use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("shaft");
    let shaft = m.spatial("shaft", SpatialPose::at(vec3(0.0, 0.0, 0.0)))?;
    m.add("motor", drive_angle(shaft, Law::ramp(1.0)))?;
    Ok(())
}
