#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Renders many studies on the nodes of a Slurm cluster.
#   pellucid-batch.sh SHARDS RECIPE PATH... --out FOLDER         submits an array of SHARDS tasks
#   sbatch --array=2,5 pellucid-batch.sh SHARDS RECIPE ...       runs tasks 2 and 5 of that array again
# SHARDS is the number of parts, 1 to MaxArraySize of the cluster; the other arguments are those of `pellucid-cli
# batch`. Recipe, studies and FOLDER must have the same paths on every node. PELLUCID_CLI names the program if it is
# not in PATH. Change the resources below, or give them to sbatch: sbatch --array=0-15 -c 8 --mem=32G
# pellucid-batch.sh 16 RECIPE ...
#SBATCH --job-name=pellucid-batch
#SBATCH --output=pellucid-batch-%A_%a.log
#SBATCH --ntasks=1
# A task whose node died starts again on another node. It continues its log.
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
if (($# < 3)) || ! [[ $1 =~ ^[1-9][0-9]*$ ]]; then
    echo "Usage: pellucid-batch.sh SHARDS RECIPE PATH... --out FOLDER [options of pellucid-cli batch]" >&2
    exit 2
fi
shards=$1
if [[ -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
    exec sbatch --array=0-$((shards - 1)) "$0" "$@"
fi
shift

# The network's home folder is no place for studies from a server. The program removes what a killed one left here.
export XDG_CACHE_HOME=${SLURM_TMPDIR:-/tmp}/pellucid-$UID
mkdir -p -m 700 "$XDG_CACHE_HOME"
if [[ -L $XDG_CACHE_HOME || ! -O $XDG_CACHE_HOME ]]; then
    echo "pellucid-batch.sh: $XDG_CACHE_HOME belongs to another user" >&2
    exit 1
fi

# The number of parts is an argument because SLURM_ARRAY_TASK_COUNT counts the tasks of this submission: with
# --array=2,5, other studies would belong to part 2. What Slurm grants limits the program even where Slurm does not.
options=(--resume --shard "$SLURM_ARRAY_TASK_ID/$shards")
[[ " $* " == *" --threads"* ]] || options+=(--threads "${SLURM_CPUS_ON_NODE:-1}")
megabytes=${SLURM_MEM_PER_NODE:-$((${SLURM_MEM_PER_CPU:-0} * ${SLURM_CPUS_ON_NODE:-1}))}
if ((megabytes > 0)) && [[ " $* " != *" --memory"* ]]; then
    options+=(--memory "$((megabytes * 3 / 4))MB") # the rest is for the program and its decoders
fi
# exec: Slurm's signals reach the program, which then stops cleanly.
exec "${PELLUCID_CLI:-pellucid-cli}" batch "$@" "${options[@]}"
