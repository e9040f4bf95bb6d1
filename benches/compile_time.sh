#!/usr/bin/env bash
# Compile time of a crate of 50 constraints (25 planar prismatic, 25 spatial cylindrical), and of one that
# holds the library's own joints, each on top of its dependencies: seconds of `cargo check` and of
# `cargo build --release`, five runs each. An argument names another checkout, to compare with it.
set -euo pipefail
root="$(cd "${1:-$(dirname "$0")/..}" && pwd)"
crate="$root/target/compile_time"
mkdir -p "$crate/src"
cat > "$crate/Cargo.toml" <<END
[package]
name = "compile_time"
version = "0.0.0"
edition = "2024"
[dependencies]
kin = { path = "$root" }
[workspace]
END
{
  echo 'use kin::prelude::*;'
  for k in $(seq 25); do cat <<END
/// Sliding joint number $k.
#[constraint]
pub fn prismatic_$k(i: Planar, j: Planar, u_i: Vec2, u_j: Vec2, h_i: Vec2, theta0: f64) -> (f64, f64) {
    (i.theta - j.theta - theta0, i.direction(h_i).dot(i.point(u_i) - j.point(u_j)) * $k.0)
}
/// Cylindrical joint number $k.
#[constraint]
pub fn cylindrical_$k(i: Spatial, j: Spatial, u_i: Vec3, u_j: Vec3, x1: Vec3, x2: Vec3, w: Vec3) -> [f64; 4] {
    let (x1, x2, w) = (i.direction(x1), i.direction(x2), j.direction(w));
    let d = i.point(u_i) - j.point(u_j);
    [x1.dot(w), x2.dot(w), x1.dot(d), x2.dot(d) * $k.0]
}
END
  done
} > "$crate/src/lib.rs"
cd "$crate"
export CARGO_TARGET_DIR="$crate/target"
seconds() {
  "$@" --quiet 2>/dev/null           # dependencies, once
  : > times
  for _ in 1 2 3 4 5; do
    touch src/lib.rs
    /usr/bin/time -a -o times -f %e "$@" --quiet 2>/dev/null
  done
  sort -n times | awk '{ t[NR] = $1 } END { printf "median %.2f s, from %.2f to %.2f s\n", t[int((NR + 1) / 2)], t[1], t[NR] }'
}
measure() {
  echo "$1"
  printf '  cargo check            '; seconds cargo check
  printf '  cargo build --release  '; seconds cargo build --release
}
measure '50 constraints'

rm -r src && mkdir src
cp -r "$root"/kin-core/src/joints/{planar,spatial,drivers} src/
sed -i 's/crate::\(numbers::\|model::\|\)\(algebra\|coordinates\|law\)/kin::\2/; s/kin_macros::constraint/kin::constraint/; s/super::drivers/crate::drivers/' $(find src -name '*.rs')
echo '#![allow(missing_docs)] pub mod drivers; pub mod planar; pub mod spatial;' > src/lib.rs
measure 'the library of joints'
