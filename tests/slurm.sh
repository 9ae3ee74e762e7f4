#!/usr/bin/env bash
# The job array of `fogbank emit slurm` on a real Slurm of one machine. Needs root and Debian's slurm-wlm and munge, which it
# installs if it can; says why it is skipped where that cannot be had. Usage: tests/slurm.sh PATH/TO/fogbank
set -euo pipefail
program="$(realpath "$1")"
repository="$(realpath "$(dirname "$0")/..")"
skip() { echo "slurm: skipped: $*"; exit 0; }

[ "$(id -u)" = 0 ] || skip "not root"
if ! command -v slurmctld slurmd munged > /dev/null; then
  command -v apt-get > /dev/null || skip "no slurm-wlm, and no apt-get to install it"
  { apt-get update && apt-get install -y --no-install-recommends slurm-wlm munge; } > /dev/null 2>&1 ||
    skip "Debian's slurm-wlm cannot be installed"
fi

work="$(mktemp -d)"
pids=()
cleanup() {
  for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null || true; done
  wait 2> /dev/null || true
  rm -rf "$work"
}
trap cleanup EXIT
mkdir -p "$work"/{state,spool,home}
dd if=/dev/urandom of="$work/munge.key" bs=128 count=1 status=none
chmod 400 "$work/munge.key"
host="$(hostname -s)"
cat > "$work/slurm.conf" << CONF
ClusterName=fog
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/ctld.pid
SlurmdPidFile=$work/d.pid
SlurmctldPort=16817
SlurmdPort=16818
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=2000
PartitionName=main Nodes=$host Default=YES State=UP
CONF
export SLURM_CONF="$work/slurm.conf"
munged --foreground --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munge.pid" \
  --log-file="$work/munge.log" --seed-file="$work/munge.seed" 2> "$work/munged.err" &
pids+=($!)
for _ in $(seq 50); do [ -S "$work/munge.socket" ] && break; sleep 0.1; done
slurmctld -D > "$work/ctld.log" 2>&1 &
pids+=($!)
slurmd -D -N "$host" > "$work/d.log" 2>&1 &
pids+=($!)
for _ in $(seq 100); do sinfo -h -o %t 2> /dev/null | grep -q idle && break; sleep 0.2; done
sinfo -h -o %t 2> /dev/null | grep -q idle || { tail -n 3 "$work"/{munged.err,ctld.log,d.log}; skip "no Slurm comes up here"; }

cd "$work/home"
cat > c.yaml << YAML
version: 1
name: slurm
scene: {file: $repository/scenes/street.glb}
fog: {model: homogeneous, height_m: 60, sigma_t_1_m: 0.02, phase: {hg: 0.8}}
lighting: day
sensor: {width_px: 24, height_px: 14}
render: {samples: 3}
sweep: {axes: {camera.altitude_m: [2, 3, 4, 5, 6, 7]}}
YAML
"$program" sweep c.yaml --out alone --quiet
"$program" emit slurm c.yaml --out out --parts 4 --cpus 1 --memory-gib 1 --time 10:00 > array.sbatch
job="$(sbatch --parsable array.sbatch)"
for _ in $(seq 300); do [ -z "$(squeue -h -j "$job" 2> /dev/null)" ] && break; sleep 0.2; done
"$program" verify out || { cat slurm-*.out; exit 1; }
diff -r --exclude='*.timing.json' alone out
echo "slurm: an array of 4 parts made the same data set as one process"
