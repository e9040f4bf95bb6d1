//! Lines of a file that is not at hand, out of what is known of it.

use serde_json::Value;

/// A frame as `.asmt` writes it.
fn frame(depth: usize, r: &Value, rows: &Value) -> String {
    let tabs = "\t".repeat(depth);
    let line = |v: &Value| format!("{tabs}\t{}\n", joined(v));
    let matrix: String = rows.as_array().expect("rows").iter().map(line).collect();
    format!("{tabs}Position3D\n{}{tabs}RotationMatrix\n{matrix}", line(r))
}

fn joined(value: &Value) -> String {
    numbers(value).iter().map(f64::to_string).collect::<Vec<String>>().join("\t")
}

/// A reference point with one marker, as deep as those of a part are.
fn marker(name: &str, end: &Value) -> String {
    let zero = serde_json::json!([0, 0, 0]);
    let same = serde_json::json!([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    let outer = frame(5, &zero, &same);
    let inner = frame(7, &end["u"], &end["R"]);
    let t = "\t".repeat(4);
    format!(
        "{t}RefPoint\n{outer}{t}\tMarkers\n{t}\t\tMarker\n{t}\t\t\tName\n{t}\t\t\t\t{name}\n{inner}"
    )
}

/// All lines of it.
pub fn written(kinematics: &Value, forces: &Value) -> String {
    let list = |of: &str, from: &Value| from[of].as_array().expect("a list").clone();
    let mut markers = std::collections::BTreeMap::<String, String>::new();
    let mut joints = String::new();
    let mut motions = String::new();
    let mut parts = String::new();
    for (k, one) in list("constraints", kinematics).iter().enumerate() {
        let [i, j] = ["I", "J"].map(|end| {
            let body = one[end]["body"].as_str().expect("a body");
            let name = format!("{end}{k}");
            *markers.entry(body.to_string()).or_default() += &marker(&name, &one[end]);
            if body == "ground" { format!("/pump/{name}") } else { format!("/pump/{body}/{name}") }
        });
        let name = one["name"].as_str().expect("a name");
        let t = "\t".repeat(4);
        let block = |kind: &str| {
            format!(
                "\t\t\t{kind}\n{t}Name\n{t}\t{name}\n{t}MarkerI\n{t}\t{i}\n{t}MarkerJ\n{t}\t{j}\n"
            )
        };
        match one["type"].as_str().expect("a type") {
            "revolute" => joints += &block("RevoluteJoint"),
            "universal" => joints += &block("UniversalJoint"),
            "spherical" => joints += &block("SphericalJoint"),
            "prismatic" => joints += &block("TranslationalJoint"),
            "point_in_plane" => joints += &block("PointInPlaneJoint"),
            "cylindrical" => joints += &block("CylindricalJoint"),
            "constant_velocity" => joints += &block("ConstantVelocityJoint"),
            "screw_row" => {
                let pitch = &one["lead"];
                joints += &format!("{}{t}pitch\n{t}\t{pitch}\n", block("ScrewJoint"));
            }
            "rack_and_pinion" => {
                let radius = &one["radius"];
                joints += &format!("{}{t}pitchRadius\n{t}\t{radius}\n", block("RackPinionJoint"));
            }
            "drive_turn" => {
                let law = one["law"].as_str().expect("a law");
                motions += &format!("{}{t}RotationZ\n{t}\t{law}\n", block("RotationalMotion"));
            }
            other => panic!("{other}"),
        }
    }
    for (body, mass) in list("bodies", kinematics).iter().zip(list("bodies", forces)) {
        let name = body["name"].as_str().expect("a name");
        let t = "\t".repeat(3);
        assert_eq!(body["name"], mass["name"]);
        parts += &format!("\t\tPart\n{t}Name\n{t}\t{name}\n{}", frame(3, &body["r"], &body["R"]));
        parts += &format!("{t}PrincipalMassMarker\n{}", frame(4, &mass["centre"], &mass["axes"]));
        parts += &format!("{t}\tMass\n{t}\t\t{}\n", mass["mass"]);
        parts += &format!("{t}\tMomentOfInertias\n{t}\t\t{}\n", joined(&mass["principal"]));
        parts += &format!("{t}RefPoints\n{}", markers.remove(name).unwrap_or_default());
    }
    let zero = serde_json::json!([0, 0, 0]);
    let same = serde_json::json!([[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
    // Those of the ground are two steps less deep.
    let ground = markers.remove("ground").unwrap_or_default();
    let ground: String = ground.lines().map(|line| format!("{}\n", &line[2..])).collect();
    format!(
        "Assembly\n\tName\n\t\tpump\n{}\tRefPoints\n{ground}\tParts\n{parts}\tConstraintSets\n\t\tJoints\n\
         {joints}\t\tMotions\n{motions}\tConstantGravity\n\t\t{}\n",
        frame(1, &zero, &same),
        joined(&forces["gravity"])
    )
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("numbers").iter().map(|x| x.as_f64().expect("a number")).collect()
}
