//! `kin run`, and `kin watch`, which runs again when the file changes.

use std::thread::sleep;
use std::time::Duration;

use kin::{Motion, Result as KinResult, System, Vec3, vec2};
use kin_view::Scene;

use crate::arguments::Run;
use crate::fault::Fault;
use crate::points::NamedPoint;
use crate::say::{Say, Written};
use crate::{model, output};

/// How long a moving picture takes to show the motion once.   [s]
const SECONDS: f64 = 3.0;
/// How often a file is looked at.
const PAUSE: Duration = Duration::from_millis(200);

/// Runs the mechanism and writes the requested files. Where the run ends early, what came before is
/// written.
pub fn run(asked: &Run, say: &Say) -> Result<(), Fault> {
    let system = model::system(&asked.model)?;
    let (mut motion, early) = model::motion(&system, &asked.motion, asked.jerk)?;
    let mut scene = Scene::new(&system);
    for point in &asked.points {
        scene = with_point(&system, &mut motion, scene, point)?;
    }
    for name in &asked.measures {
        add_measure(&system, &mut motion, name).map_err(Fault::asked)?;
    }
    say.note(&motion.summary());
    say.warnings(&motion, Written::InSummary);
    let events = motion.events().iter().filter(|event| !event.kind.is_warning());
    events.for_each(|event| say.note(&event.to_string()));
    let why = early.as_ref().map(Fault::why_early).unwrap_or_default();
    written(asked, &motion, &scene, &why)?;
    early.map_or(Ok(()), Err)
}

/// Writes each file that the command line names. `why` is why the run ended early, which the page
/// says.
fn written(asked: &Run, motion: &Motion, scene: &Scene, why: &str) -> Result<(), Fault> {
    if let Some(to) = &asked.csv {
        output::put(to, |to| motion.write_csv_to(to))?;
    }
    if let Some(to) = &asked.json {
        output::put(to, |to| {
            serde_json::to_writer(&mut *to, &motion.data())?;
            to.write_all(b"\n")
        })?;
    }
    if let Some(to) = &asked.svg {
        let picture = scene.animated(motion, SECONDS)?;
        output::put(to, |to| to.write_all(picture.svg().as_bytes()))?;
    }
    if let Some(to) = &asked.page {
        let mut page = scene.page(motion)?.asked(&asked.motion.times.0).ended(why);
        for output in motion.outputs() {
            page = page.chart(output.name(), [(output.name(), output)]);
        }
        let page = page.html();
        output::put(to, |to| to.write_all(page.as_bytes()))?;
    }
    Ok(())
}

/// Adds a point to the motion, and its path to the picture.
fn with_point(
    system: &System,
    motion: &mut Motion,
    scene: Scene,
    NamedPoint { name, body, local }: &NamedPoint,
) -> Result<Scene, Fault> {
    let planar = motion.planar_named(body);
    let spatial = motion.spatial_named(body);
    let added: KinResult<Scene> = match (planar, spatial, &local[..]) {
        (Some(body), _, &[x, y]) => {
            motion.add_point(name, body, [x, y]).map(|()| scene.trace(name, body, vec2(x, y)))
        }
        (_, Some(body), &[x, y, z]) => {
            let u = Vec3::new(x, y, z);
            motion.add_point(name, body, u).map(|()| scene.trace(name, body, u))
        }
        (None, None, _) => {
            let known = system.bodies().into_iter().map(|(name, _)| name.to_string()).collect();
            Err(kin::Error::UnknownName { what: "body", name: body.clone(), known })
        }
        (planar, ..) => {
            let (is, n) = if planar.is_some() { ("planar", 2) } else { ("spatial", 3) };
            return Err(Fault::Usage(format!(
                "`{body}` is a {is} body. Give {n} numbers for its point"
            )));
        }
    };
    added.map_err(Fault::asked)
}

/// Adds a measure and its rates to the file.
fn add_measure(system: &System, motion: &mut Motion, name: &str) -> KinResult<()> {
    let measure = system.measure(motion, name)?;
    for (series, mark) in [(&measure.value, ""), (&measure.rate, "'"), (&measure.second_rate, "''")]
    {
        motion.add_output(&format!("{name}{mark}"), series.unit(), series.values().to_vec())?;
    }
    Ok(())
}

/// Runs, and runs again each time the file has another content. It ends when nobody reads its
/// output any more; it reports faults and continues to watch the file.
pub fn watch(asked: &Run, say: &Say) -> Result<(), Fault> {
    let file = &asked.model.file;
    if file == "-" {
        return Err(Fault::Usage(
            "standard input does not change. Give a file to watch".to_string(),
        ));
    }
    let mut known = model::text(file)?;
    loop {
        match run(asked, say) {
            Err(Fault::Pipe) => return Err(Fault::Pipe),
            end => {
                say.ended(end);
            }
        }
        say.note(&format!("watching {file}"));
        known = changed(file, &known);
    }
}

/// The content of the file once it is another one. A file that is missing is one that is being
/// written.
fn changed(file: &str, known: &str) -> String {
    let stamp = || std::fs::metadata(file).and_then(|of| of.modified()).ok();
    let mut seen = None;
    loop {
        let now = stamp();
        if now.is_some() && now != seen {
            seen = now;
            if let Some(text) =
                model::text(file).ok().filter(|text| text != known && !text.is_empty())
            {
                return text;
            }
        }
        sleep(PAUSE);
    }
}
