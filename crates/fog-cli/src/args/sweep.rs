//! Arguments of `sweep`.

use super::{ConfigArgs, WorkArgs};
use clap::{Args as ClapArgs, ValueEnum};
use fogbank::Shard;
use fogbank::dataset::Opening;
use fogbank::plan::Filter;
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  fogbank sweep c.yaml --out out                              all that is missing, on all cores
  fogbank sweep c.yaml --out out --workers 4 --frame-timeout 600   four processes; one that dies or hangs is replaced
  fogbank sweep c.yaml --out out --where 'fog.height_m>=180, lighting=night'
  fogbank sweep c.yaml --out out --shard 3/8                  the fourth of eight parts (on a shared folder, or join the
                                                              folders with `fogbank merge`)
  fogbank sweep c.yaml --out out --shard auto                 in a Slurm job array: its own part
  fogbank sweep c.yaml --out out --mode extend                after values were added to an axis
  fogbank sweep c.yaml --out out --log json > log.jsonl       what happens as lines of JSON

Any number of processes and machines may fill one folder at the same time; every frame has the same bytes whoever makes it.
Ctrl-C gives up the frames at work and keeps those that are done; a second one ends the program at once.

Exit codes: 0 all selected frames are done, 1 a frame failed, 2 wrong arguments, configuration or files, 130 stopped.";

/// Arguments of `sweep`.
#[derive(Debug, ClapArgs)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SweepArgs {
    #[command(flatten)]
    pub(crate) config: ConfigArgs,
    #[command(flatten)]
    pub(crate) work: WorkArgs,
    /// Processes to render with, which share scenes and tables; one that dies is replaced and its frame tried again
    /// [default: this one alone]. `--threads` then counts for each [default: cores / N].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) workers: Option<u16>,
    /// Longest time for a frame; its worker is replaced then and the frame tried once more.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub(crate) frame_timeout: Option<Duration>,
    /// Only part I of N equal parts, counted from 0 [default: all]. `auto` takes both from a Slurm job array; `auto/N` takes I
    /// from SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX (Kubernetes) or AWS_BATCH_JOB_ARRAY_INDEX.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    pub(crate) shard: Option<Shard>,
    /// Only this frame: its id, the beginning of its id, or its index from 0 (see `fogbank plan`); may be repeated.
    #[arg(long, value_name = "ID")]
    pub(crate) only: Vec<String>,
    /// Only frames with these values, as 'fog.height_m>=180, lighting=night'; keys as in `fogbank plan --json`.
    #[arg(long = "where", value_name = "CONDITIONS", value_parser = filter)]
    pub(crate) filter: Option<Filter>,
    /// What becomes of a data set that is there already.
    #[arg(long, value_enum, default_value = "resume")]
    pub(crate) mode: ModeArg,
    /// Hash the files of frames that are done and render damaged ones again.
    #[arg(long)]
    pub(crate) recheck: bool,
    /// Try frames again that have failed.
    #[arg(long)]
    pub(crate) retry_failed: bool,
}

/// What becomes of a data set that is there already.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum ModeArg {
    /// Render what is missing; refuse the data set of another configuration.
    Resume,
    /// Render the selected frames again; replace the data set of another configuration.
    Overwrite,
    /// Take a configuration that has all old frames and more; keep the old ones.
    Extend,
}

impl From<ModeArg> for Opening {
    fn from(mode: ModeArg) -> Self {
        match mode {
            ModeArg::Resume => Self::Resume,
            ModeArg::Overwrite => Self::Overwrite,
            ModeArg::Extend => Self::Extend,
        }
    }
}

fn filter(text: &str) -> Result<Filter, String> {
    Filter::parse(text).map_err(|e| e.to_string())
}

fn seconds(text: &str) -> Result<Duration, String> {
    let wrong = || format!("`{text}` is no number of seconds above 0, up to 1e9");
    let seconds: f64 = text.parse().map_err(|_| wrong())?;
    if seconds > 0.0 && seconds <= 1e9 { Ok(Duration::from_secs_f64(seconds)) } else { Err(wrong()) }
}

fn shard(text: &str) -> Result<Shard, String> {
    parse_shard(text, &|key| std::env::var(key).ok())
}

/// `I/N`, `auto/N` or `auto`, with the environment's variables.
fn parse_shard(text: &str, variable: &dyn Fn(&str) -> Option<String>) -> Result<Shard, String> {
    let number = |key: &str| -> Result<Option<u64>, String> {
        let Some(text) = variable(key) else { return Ok(None) };
        text.trim().parse().map(Some).map_err(|_| format!("{key} is `{text}`, which is no number from 0"))
    };
    let (index, count) = text.split_once('/').map_or((text, None), |(index, count)| (index, Some(count)));
    let count = match count {
        Some(count) => count.parse().map_err(|_| format!("`{count}` is no number of parts"))?,
        None if index == "auto" => number("SLURM_ARRAY_TASK_COUNT")?
            .ok_or("`auto` needs SLURM_ARRAY_TASK_COUNT; elsewhere give the number of parts: auto/N")?,
        None => return Err("expected I/N with I from 0, as 0/4, or auto".to_owned()),
    };
    let index = match index {
        "auto" => match number("SLURM_ARRAY_TASK_ID")? {
            Some(id) => {
                let first = number("SLURM_ARRAY_TASK_MIN")?.unwrap_or(0);
                let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1).max(1);
                id.checked_sub(first).ok_or("SLURM_ARRAY_TASK_ID is below SLURM_ARRAY_TASK_MIN")? / step
            }
            None => match number("JOB_COMPLETION_INDEX")? {
                Some(index) => index,
                None => number("AWS_BATCH_JOB_ARRAY_INDEX")?.ok_or(
                    "`auto` needs SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX or AWS_BATCH_JOB_ARRAY_INDEX",
                )?,
            },
        },
        index => index.parse().map_err(|_| format!("`{index}` is no number of a part"))?,
    };
    if index < count {
        Ok(Shard { index, count })
    } else {
        Err(format!("there is no part {index} of {count}: parts count from 0"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_by_hand_and_from_job_arrays() {
        let with = |text: &str, variables: &[(&str, &str)]| {
            let find = |key: &str| variables.iter().find(|(k, _)| *k == key).map(|(_, v)| (*v).to_owned());
            parse_shard(text, &find).map(|shard| (shard.index, shard.count))
        };
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "7"),
            ("SLURM_ARRAY_TASK_COUNT", "4"),
            ("SLURM_ARRAY_TASK_MIN", "1"),
            ("SLURM_ARRAY_TASK_STEP", "2"),
        ];
        assert_eq!(with("2/5", &[]), Ok((2, 5)));
        assert_eq!(with("auto", &slurm), Ok((3, 4)));
        assert_eq!(with("auto/9", &[("JOB_COMPLETION_INDEX", "8")]), Ok((8, 9)));
        assert_eq!(with("auto/3", &[("AWS_BATCH_JOB_ARRAY_INDEX", "0")]), Ok((0, 3)));
        for (text, variables) in [
            ("5/5", &[][..]),
            ("1/0", &[]),
            ("1", &[]),
            ("-1/3", &[]),
            ("auto", &[("JOB_COMPLETION_INDEX", "8")]),
            ("auto/3", &[]),
            ("auto/3", &[("JOB_COMPLETION_INDEX", "x")]),
        ] {
            assert!(with(text, variables).is_err(), "{text}");
        }
    }
}
