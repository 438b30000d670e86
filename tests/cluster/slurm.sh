#!/usr/bin/env bash
# slurm.sh PROGRAM SCENE: starts a cluster of three nodes on this host, renders SCENE in 16 shards
# by `exphoton cluster --submit`, kills one slurmd and one shard in the middle, and compares the
# picture with that of one process. Does the same, without the slurmd, for a picture with AOVs under
# --target-error, an animation, a study and a file of photons. Ends with 77 (skipped) where Slurm or the rights are missing.
# It listens on the loopback only and ends every process that it started.
set -euo pipefail
program=$(realpath "$1") scene=$(realpath "$2")

skip() {
  printf 'SKIPPED: %s\n' "$1"
  exit 77
}
PATH=$PATH:/usr/sbin
for tool in munged slurmctld slurmd sbatch; do
  command -v "$tool" >/dev/null || skip "$tool is missing: apt-get install slurm-wlm munge"
done
[ "$(id -u)" = 0 ] || skip "slurmd needs the rights of root"
case "$(slurmctld -V)" in slurm*) ;; *) skip "slurmctld does not start" ;; esac

work=$(mktemp -d /tmp/exphoton-slurm.XXXXXX)
chmod 755 "$work"
processes=()
cleanup() {
  local status=$?
  export SLURM_CONF=$work/slurm.conf
  timeout 20 scancel --user=root >/dev/null 2>&1 || true
  sleep 1
  for process in "${processes[@]}"; do kill "$process" 2>/dev/null || true; done
  sleep 1
  for process in "${processes[@]}"; do kill -9 "$process" 2>/dev/null || true; done
  # Steps outlive a slurmd that was killed. Only those of this cluster have its configuration.
  for process in $(pgrep slurmstepd || true); do
    if tr '\0' '\n' <"/proc/$process/environ" 2>/dev/null | grep -q "^SLURM_CONF=$work/"; then
      kill -9 "$process" 2>/dev/null || true
    fi
  done
  for process in $(pgrep -f -- "$work/" || true); do
    [ "$process" = $$ ] || kill -9 "$process" 2>/dev/null || true
  done
  if [ $status != 0 ]; then
    tail -n 20 "$work"/*.log "$work"/picture.exr.parts/logs/* 2>/dev/null || true
  fi
  rm -rf "$work"
  exit $status
}
trap cleanup EXIT

# Three free ports for the nodes and one for the controller.
ports=($(python3 - <<'P'
import socket
sockets = [socket.socket() for _ in range(4)]
for s in sockets: s.bind(("127.0.0.1", 0))
print(*[s.getsockname()[1] for s in sockets])
P
))
host=$(hostname -s)
mkdir "$work/run" "$work/spool" "$work/state"
dd if=/dev/urandom of="$work/munge.key" bs=1024 count=1 status=none
chmod 600 "$work/munge.key"

cat >"$work/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[3]}
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CryptoType=crypto/munge
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=30
InactiveLimit=0
KillWait=2
MinJobAge=300
SchedulerParameters=sched_interval=2
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmdParameters=config_overrides
CONF
for n in 0 1 2; do
  echo "NodeName=n$n NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[n]} CPUs=1 State=UNKNOWN"
done >>"$work/slurm.conf"
echo "PartitionName=all Nodes=n[0-2] Default=YES MaxTime=INFINITE State=UP" >>"$work/slurm.conf"
export SLURM_CONF=$work/slurm.conf

munged -F --force --key-file="$work/munge.key" --socket="$work/munge.socket" \
  --pid-file="$work/munge.pid" --log-file="$work/munge.log" --seed-file="$work/munge.seed" &
processes+=($!)
for _ in $(seq 100); do [ ! -S "$work/munge.socket" ] || break; sleep .1; done
cd "$work/run"
slurmctld -D -f "$work/slurm.conf" >"$work/slurmctld.out" 2>&1 &
processes+=($!)
for n in 0 1 2; do
  mkdir -p "$work/spool/n$n"
  slurmd -D -N "n$n" -f "$work/slurm.conf" >"$work/slurmd-n$n.out" 2>&1 &
  processes+=($!)
done
# slurmd runs in the foreground, so these are the daemons themselves.
node=${processes[3]}

wait_for() {  # wait_for SECONDS WHAT COMMAND...
  local seconds=$1 what=$2
  shift 2
  for _ in $(seq $((seconds * 5))); do
    if "$@"; then return; fi
    sleep .2
  done
  echo "FAILED: waited $seconds s until $what"
  exit 1
}
all_idle() { [ "$(timeout 10 sinfo -h -N -t idle -o %N 2>/dev/null | wc -l)" = 3 ]; }
wait_for 60 "three nodes are idle" all_idle

options=(--reproducible --spp "${SPP:-64}" --resolution 96x96)
"$program" "$scene" "${options[@]}" --quiet -o "$work/one.exr"

"$program" cluster "$scene" --shards 16 -o "$work/picture.exr" --submit -- "${options[@]}"
parts=$work/picture.exr.parts/parts
some_parts() { [ "$(ls "$parts" | grep -c '\.state$')" -ge 2 ]; }
wait_for 120 "two parts are rendered" some_parts

# kill_one PATTERN: ends a process whose command line has the pattern.
kill_one() {
  local process
  process=$(pgrep -o -f -- "$1") && kill -9 "$process"
}
wait_for 60 "a shard runs" kill_one "render .*--shard [0-9]+/16 -o $parts"
kill -9 "$node"
echo "killed a shard and the slurmd of node n1"

has_picture() { [ -f "$work/picture.exr" ]; }
wait_for 300 "the picture is merged" has_picture
cmp "$work/one.exr" "$work/picture.exr"
# submitted FOLDER: how often tasks were submitted after the first time.
submitted() { cat "$1"/logs/* | grep -c '^submitted' || true; }
again=$(submitted "$work/picture.exr.parts")
[ "$again" -ge 1 ] || { echo "FAILED: no shard was submitted again"; exit 1; }
echo "the picture has the bytes of one process; shards were submitted again $again times"

# A picture of a wanted accuracy, with AOVs.
options=(--reproducible --spp 8 --resolution 48x48 --target-error 1e-3 --max-passes 6
  --aov variance,albedo,indirect)
"$program" "$scene" "${options[@]}" --quiet -o "$work/one.exr"
"$program" cluster "$scene" --shards 6 -o "$work/accurate.exr" --submit -- "${options[@]}"
wait_for 60 "a shard runs" kill_one "render .*--shard [0-9]+/6 -o $work/accurate"
wait_for 300 "the accurate picture is merged" test -f "$work/accurate.exr"
cmp "$work/one.exr" "$work/accurate.exr"
echo "so has the picture with AOVs under --target-error"

# An animation of four frames.
options=(--reproducible --spp 16 --resolution 48x48)
"$program" "$scene" "${options[@]}" --frames 1-4 --quiet -o "$work/one%d.exr"
"$program" cluster "$scene" --frames 1-4 -o "$work/frame%d.exr" --submit -- "${options[@]}"
wait_for 60 "a frame is rendered" kill_one "render .*--frames [0-9] -o $work/frame"
has_frames() { [ "$(ls "$work" | grep -c '^frame[1-4].exr$')" = 4 ]; }
wait_for 300 "all frames are rendered" has_frames
for frame in 1 2 3 4; do cmp "$work/one$frame.exr" "$work/frame$frame.exr"; done
echo "so have the frames of an animation"

# A study.
options=("$scene" --integrators path,exphotonmap --vary spp=2,8 --seeds 2 --resolution 48x48
  --no-maps --make-reference "path maxdepth=20" --reference-time 4s)
"$program" study "${options[@]}" --out "$work/one" --quiet >/dev/null
"$program" study "${options[@]}" --out "$work/study" --tasks 3 --submit
wait_for 60 "a task runs" kill_one "study .*--task [0-9]/3 --out $work/study"
wait_for 300 "the study is made" test -f "$work/study/report.html"
for picture in "$work"/one/images/*.exr; do cmp "$picture" "$work/study/images/${picture##*/}"; done
again=$(submitted "$work/study.tasks")
[ "$again" -ge 1 ] || { echo "FAILED: no task was submitted again"; exit 1; }
grep -q 'Each render had its machine for itself' "$work/study/report.html"
echo "so have the pictures of a study; tasks were submitted again $again times"

# Photons in shares. The merge is repeated by hand, as the page for users says.
options=("$scene" --set SurfaceIntegrator.indirectphotons=400000)
"$program" photons "${options[@]}" -o "$work/one.expm" --quiet
for round in 1 2 3; do
  missing=$("$program" photons "${options[@]}" --merge "$work/shares" --missing 2>/dev/null || echo 1-6)
  [ -n "$missing" ] || break
  sbatch --array="$missing" --wait --wrap "'$program' photons '${options[0]}' ${options[*]:1} \
    --shard \$SLURM_ARRAY_TASK_ID/6 -o '$work/shares' --no-progress" >/dev/null &
  waiting=$!
  [ $round != 1 ] || wait_for 60 "a share is shot" kill_one "photons .*--shard [0-9]/6"
  wait $waiting || true
done
"$program" photons "${options[@]}" --merge "$work/shares" -o "$work/merged.expm" --quiet
cmp "$work/one.expm" "$work/merged.expm"
echo "so has the file of photons; shares were submitted $((round - 1)) times"
