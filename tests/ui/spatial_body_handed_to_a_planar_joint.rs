use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("arm");
    let arm = m.spatial("arm", SpatialPose::at(vec3(0.0, 0.0, 0.0)))?;
    m.add("pin", revolute(m.ground(), arm, vec2(0.0, 0.0), vec2(0.0, 0.0)))?;
    Ok(())
}
