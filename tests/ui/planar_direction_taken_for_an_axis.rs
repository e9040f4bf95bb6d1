use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("shaft");
    let shaft = m.spatial("shaft", SpatialPose::at(vec3(0.0, 0.0, 0.0)))?;
    let (o, z) = (vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0));
    m.add("bearing", spatial::revolute(m.ground(), shaft, o, o, vec2(0.0, 1.0), z))?;
    Ok(())
}
