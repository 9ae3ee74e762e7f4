//! `fogbank emit`: a sweep as a job array of a cluster.

use crate::args::{EmitArgs, EmitCommand, KubernetesArgs, PartsArgs, SlurmArgs};
use crate::print;
use anyhow::{Context, Result};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Parts that are made of a plan unless said otherwise.
const MOST_PARTS: usize = 100;

pub(crate) fn run(args: &EmitArgs) -> Result<ExitCode> {
    let text = match &args.system {
        EmitCommand::Slurm(args) => slurm(args)?,
        EmitCommand::Kubernetes(args) => kubernetes(args)?,
    };
    print::news(text.trim_end());
    Ok(ExitCode::SUCCESS)
}

/// Name of the plan and number of its parts; the configuration is read, so that no array is queued that cannot run.
fn plan(parts: &PartsArgs) -> Result<(String, u64)> {
    let plan = fogbank::plan::load(&parts.config.config, &parts.config.sets).map_err(fogbank::Error::from)?;
    let count = parts.parts.map_or(plan.len().min(MOST_PARTS) as u64, u64::from);
    Ok((plan.name().to_owned(), count))
}

/// The command line of a part. Frames that failed in a part that was run again are tried again.
fn command(parts: &PartsArgs, program: &str, shard: &str) -> Vec<String> {
    let text = |path: &Path| path.display().to_string();
    let mut beside = parts.out.clone().into_os_string();
    beside.push(".tables");
    let tables = parts.cache_dir.clone().unwrap_or_else(|| PathBuf::from(beside));
    let mut words = vec![program.to_owned(), "sweep".to_owned(), text(&parts.config.config)];
    let options = [
        ("--out", text(&parts.out)),
        ("--cache-dir", text(&tables)),
        ("--shard", shard.to_owned()),
        ("--threads", parts.cpus.to_string()),
        ("--log", "json".to_owned()),
    ];
    words.extend(options.into_iter().flat_map(|(key, value)| [key.to_owned(), value]));
    words.extend(parts.config.sets.iter().flat_map(|set| ["--set".to_owned(), set.clone()]));
    words.push("--retry-failed".to_owned());
    words
}

fn slurm(args: &SlurmArgs) -> Result<String> {
    let (name, count) = plan(&args.parts)?;
    let program = match &args.program {
        Some(program) => program.clone(),
        None => std::env::current_exe().context("where this program is")?,
    };
    let command = command(&args.parts, &program.display().to_string(), "auto");
    let partition =
        args.partition.as_ref().map_or_else(String::new, |name| format!("#SBATCH --partition={name}\n"));
    Ok(format!(
        "#!/bin/sh\n\
         #SBATCH --job-name={name}\n\
         #SBATCH --array=0-{last}\n\
         #SBATCH --cpus-per-task={cpus}\n\
         #SBATCH --mem={memory}G\n\
         #SBATCH --time={time}\n\
         #SBATCH --requeue\n\
         {partition}\
         # The folder is the one that sbatch was called in: paths of the configuration count from there.\n\
         cd \"$SLURM_SUBMIT_DIR\" || exit 2\n\
         exec {command}\n",
        last = count - 1,
        cpus = args.parts.cpus,
        memory = args.parts.memory_gib,
        time = args.time,
        command = command.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" "),
    ))
}

/// A word as a shell reads it.
fn quoted(word: &str) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"/._-=:,+".contains(&b);
    if !word.is_empty() && word.bytes().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// The job as JSON, which is YAML too.
fn kubernetes(args: &KubernetesArgs) -> Result<String> {
    let (name, count) = plan(&args.parts)?;
    // Names of Kubernetes are those of hosts.
    let name: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect();
    let resources = json!({
        "cpu": args.parts.cpus.to_string(),
        "memory": format!("{}Gi", args.parts.memory_gib),
    });
    let job = json!({
        "apiVersion": "batch/v1",
        "kind": "Job",
        "metadata": { "name": format!("fogbank-{}", name.trim_matches('-')) },
        "spec": {
            "completionMode": "Indexed",
            "completions": count,
            "parallelism": args.parallelism.map_or(count, u64::from),
            "backoffLimitPerIndex": 3,
            "maxFailedIndexes": count,
            "template": {
                "spec": {
                    "restartPolicy": "Never",
                    "containers": [{
                        "name": "fogbank",
                        "image": args.image,
                        "workingDir": args.mount,
                        "command": command(&args.parts, "fogbank", &format!("auto/{count}")),
                        "resources": { "requests": resources, "limits": resources },
                        "volumeMounts": [{ "name": "data", "mountPath": args.mount }],
                    }],
                    "volumes": [{ "name": "data", "persistentVolumeClaim": { "claimName": args.claim } }],
                },
            },
        },
    });
    Ok(serde_json::to_string_pretty(&job)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_survive_a_shell() {
        assert_eq!(quoted("/a/b-c.yaml"), "/a/b-c.yaml");
        assert_eq!(quoted("fog.height_m=[1, 2]"), "'fog.height_m=[1, 2]'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
        assert_eq!(quoted(""), "''");
    }
}
