use kin::prelude::*;

#[constraint]
fn upright(i: Spatial, z: f64) -> f64 {
    i.r.z - z
}

fn main() -> kin::Result<()> {
    let mut m = Mechanism::new("arm");
    let arm = m.link("arm", 1.0)?;
    m.add("upright", upright(arm, 0.0))?;
    Ok(())
}
