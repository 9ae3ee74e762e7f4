//! Poses from a CSV file.

use std::{
    collections::HashMap,
    path::{Path as FilePath, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

use fog_core::attitude::Attitude;

use super::{MAX_POSES, Path, PathPose};
use crate::{ranges, rig::PoseSpec, text_file::read_table};

/// CSV files read so far: each once, so that all frames see one content.
#[derive(Clone, Debug, Default)]
pub(crate) struct CsvFiles(Arc<Mutex<HashMap<PathBuf, Read>>>);

/// The path in a file, or why there is none.
type Read = Result<Arc<Path>, String>;

const POSITION: [&str; 4] = ["time_s", "x_m", "y_m", "z_m"];
const ANGLES: [&str; 3] = ["heading_deg", "pitch_deg", "roll_deg"];
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];

impl CsvFiles {
    /// The path in a file.
    ///
    /// # Errors
    /// A message with file, line and column.
    pub(crate) fn path(&self, file: &FilePath) -> Result<Arc<Path>, String> {
        let mut files = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let read = || {
            let text =
                read_table(file).map_err(|error| format!("cannot read {}: {error}", file.display()))?;
            parse(&text).map(Arc::new).map_err(|message| format!("{}:{message}", file.display()))
        };
        files.entry(file.to_owned()).or_insert_with(read).clone()
    }
}

/// A cell as messages quote it.
fn shortened(cell: &str) -> String {
    cell.chars().take(60).collect()
}

/// Reads the text of a file. Messages begin with the line.
fn parse(text: &str) -> Result<Path, String> {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text.lines().enumerate().filter(|(_, line)| {
        let line = line.trim();
        !(line.is_empty() || line.starts_with('#'))
    });
    let cells = |line: &str| -> Vec<String> { line.split(',').map(|cell| cell.trim().to_owned()).collect() };
    let Some((at, head)) = lines.next() else { return Err("1: no poses".into()) };
    let names = cells(head);
    let known = POSITION.iter().chain(&ANGLES).chain(&QUATERNION).copied().collect::<Vec<_>>();
    for (i, name) in names.iter().enumerate() {
        if !known.contains(&name.as_str()) {
            let (name, known) = (shortened(name), known.join(", "));
            return Err(format!("{}: column `{name}` is unknown; expected {known}", at + 1));
        }
        if names[..i].contains(name) {
            return Err(format!("{}: column `{name}` is there twice", at + 1));
        }
    }
    let column = |name: &str| names.iter().position(|n| n == name);
    let by_quaternion = QUATERNION.iter().any(|name| column(name).is_some());
    let turned: &[&str] = if by_quaternion { &QUATERNION } else { &ANGLES };
    let wanted: Vec<&str> = POSITION.iter().chain(turned).copied().collect();
    if by_quaternion && ANGLES.iter().any(|name| column(name).is_some()) {
        return Err(format!("{}: give angles or a quaternion, not both", at + 1));
    }
    let columns: Vec<usize> = wanted
        .iter()
        .map(|name| column(name).ok_or_else(|| format!("{}: column `{name}` is missing", at + 1)))
        .collect::<Result<_, _>>()?;
    let mut poses: Vec<PathPose> = Vec::new();
    for (at, line) in lines {
        let cells = cells(line);
        if cells.len() != names.len() {
            return Err(format!("{}: {} cells in a table of {} columns", at + 1, cells.len(), names.len()));
        }
        let mut numbers = Vec::with_capacity(columns.len());
        for (&i, name) in columns.iter().zip(&wanted) {
            let number = cells[i].parse::<f64>().ok().filter(|number| number.is_finite());
            let number = number
                .ok_or_else(|| format!("{}: {name}: \"{}\" is not a number", at + 1, shortened(&cells[i])))?;
            numbers.push(number);
        }
        let pose = pose(&numbers, by_quaternion).map_err(|message| format!("{}: {message}", at + 1))?;
        if let Some(last) = poses.last().filter(|last| last.time_s >= pose.time_s) {
            let message = format!("{}: time_s: {} does not come after {}", at + 1, pose.time_s, last.time_s);
            return Err(message);
        }
        if poses.len() == MAX_POSES {
            return Err(format!("{}: more than {MAX_POSES} poses", at + 1));
        }
        poses.push(pose);
    }
    if poses.is_empty() {
        return Err(format!("{}: no poses", at + 1));
    }
    Ok(Path { poses, moves: true })
}

/// Time, position, and three angles or four components of a quaternion.
fn pose(numbers: &[f64], by_quaternion: bool) -> Result<PathPose, String> {
    if !ranges::TIME_S.contains(numbers[0]) {
        return Err(format!("time_s: {}", ranges::TIME_S.message("time_s", numbers[0])));
    }
    let position = [numbers[1], numbers[2], numbers[3]];
    for (name, value) in ["x_m", "y_m", "z_m"].iter().zip(position) {
        if !ranges::POSITION_M.contains(value) {
            return Err(format!("{name}: {}", ranges::POSITION_M.message(name, value)));
        }
    }
    let angles = if by_quaternion {
        let q = [numbers[4], numbers[5], numbers[6], numbers[7]];
        let attitude = Attitude::from_quaternion_wxyz(q).ok_or("qw, qx, qy, qz: all 0 is no rotation")?;
        attitude.angles_deg()
    } else {
        for (name, (value, range)) in ANGLES.iter().zip(numbers[4..].iter().zip([
            ranges::HEADING_DEG,
            ranges::PITCH_DEG,
            ranges::ROLL_DEG,
        ])) {
            if !range.contains(*value) {
                return Err(format!("{name}: {}", range.message(name, *value)));
            }
        }
        [numbers[4], numbers[5], numbers[6]]
    };
    Ok(PathPose { time_s: numbers[0], pose: PoseSpec::new(position, angles), approach: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_and_quaternions() {
        let angles = parse(
            "# flown\ntime_s,x_m,y_m,z_m,heading_deg,pitch_deg,roll_deg\n0,1,2,3,90,0,0\n0.5,1,2,4,90,0,5\n",
        )
        .unwrap();
        assert_eq!(angles.poses[1].time_s, 0.5);
        assert_eq!(angles.poses[1].pose, PoseSpec::new([1.0, 2.0, 4.0], [90.0, 0.0, 5.0]));
        // Columns in any order; the quaternion of heading 90 degrees.
        let quaternion = parse("qw,qx,qy,qz,time_s,z_m,y_m,x_m\n0,0.5,0,0.5,0,3,2,1\n").unwrap();
        assert_eq!(quaternion.poses[0], angles.poses[0]);
    }

    #[test]
    fn mistakes_name_line_and_column() {
        let head = "time_s,x_m,y_m,z_m,heading_deg,pitch_deg,roll_deg\n";
        let message = |text: &str| parse(text).unwrap_err();
        assert_eq!(message(""), "1: no poses");
        assert_eq!(message(head), "1: no poses");
        assert_eq!(message("time_s,x_m,y_m,z_m\n0,0,0,0\n"), "1: column `heading_deg` is missing");
        assert_eq!(message(&format!("{head}0,0,0\n")), "2: 3 cells in a table of 7 columns");
        assert_eq!(message(&format!("{head}0,x,0,0,0,0,0\n")), "2: x_m: \"x\" is not a number");
        assert_eq!(
            message(&format!("{head}1,0,0,0,0,0,0\n\n1,0,0,0,0,0,0\n")),
            "4: time_s: 1 does not come after 1"
        );
        assert_eq!(
            message(&format!("{head}1,0,0,0,0,95,0\n")),
            "2: pitch_deg: 95 deg is out of range; valid: -90 to 90 deg"
        );
        assert_eq!(
            message("time_s,x,y_m,z_m\n"),
            "1: column `x` is unknown; expected time_s, x_m, y_m, z_m, heading_deg, pitch_deg, roll_deg, qw, qx, qy, qz"
        );
    }
}
