use kin::prelude::*;

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 1.0)?;
    m.add("ball", spatial::spherical(m.ground(), arm, vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 0.0)))?;
    Ok(())
}
