#!/usr/bin/env bash
# Time of one study by threads of one process and by ranks of MPI, alternately: writes the table into docs/clusters.md.
#
#   scripts/scaling.sh [REPEATS [REALIZATIONS]]      repeats: 5; realizations in each of the 16 cells: 2048
set -euo pipefail

cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
repeats=${1:-5} realizations=${2:-2048}
scripts/install_packages.sh
scripts/install_packages.sh libopenmpi-dev openmpi-bin
cmake --preset release -DSTYLOBATE_MPI=ON >/dev/null
cmake --build build/release --target stylobate --parallel "$(nproc)"
root=$PWD program=$PWD/build/release/studies/stylobate study=$PWD/studies/inputs/small_scale_column.toml page=$PWD/docs/clusters.md
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

set=(--set study.realizations="$realizations"
     --set surface.frequency_hz='{ from = 4.0, to = 8.0, count = 4 }'
     --set surface.pga_m_s2='{ from = 4.0, to = 12.0, count = 4 }' --quiet)
processes() { # HOW: "threads 2" or "ranks 2"
    case $1 in
    threads) "$program" run "$study" "${set[@]}" --threads "$2" -o out.h5 ;;
    ranks) mpirun --oversubscribe --bind-to none -n "$2" "$program" run "$study" "${set[@]}" --mpi --threads 1 -o out.h5 ;;
    esac >/dev/null
}
ways=("threads 1" "threads 2" "ranks 1" "ranks 2" "ranks 4")
for ((i = 0; i < repeats; ++i)); do
    for way in "${ways[@]}"; do
        rm -f out.h5
        begin=$(date +%s.%N)
        processes $way
        echo "$way $(date +%s.%N) $begin" >>times
        [[ -e first.h5 ]] || cp out.h5 first.h5
        cmp first.h5 out.h5
    done
done
awk -v realizations=$((16 * realizations)) -v repeats="$repeats" \
    -v machine="$(grep -m1 'model name' /proc/cpuinfo | sed 's/.*: //'), $(nproc) cores, $(date +%F)" '
    { way = $1 " " $2; t[way, ++n[way]] = $3 - $4; order[NR] = way }
    function median(way, i, j, x, k) {
        k = n[way]
        for (i = 1; i <= k; ++i) a[i] = t[way, i]
        for (i = 2; i <= k; ++i) { x = a[i]; for (j = i - 1; j > 0 && a[j] > x; --j) a[j + 1] = a[j]; a[j + 1] = x }
        return k % 2 ? a[(k + 1) / 2] : (a[k / 2] + a[k / 2 + 1]) / 2
    }
    END {
        printf "A surface of %d realizations (16 cells of `small_scale_column.toml`), %d times each, alternately; %s.\n\n", realizations, repeats, machine
        print "| | elapsed, median [s] | fastest, slowest [s] | speed of one thread |"
        print "|---|---:|---:|---:|"
        one = median("threads 1")
        for (r = 1; r <= NR && !(order[r] in seen); ++r) {
            way = order[r]; seen[way]
            m = median(way); lo = hi = t[way, 1]
            for (i = 2; i <= n[way]; ++i) { if (t[way, i] < lo) lo = t[way, i]; if (t[way, i] > hi) hi = t[way, i] }
            split(way, w, " ")
            printf "| %s %s%s | %.2f | %.2f, %.2f | %.2f |\n", w[2], w[2] == 1 ? substr(w[1], 1, length(w[1]) - 1) : w[1], w[1] == "ranks" ? " of one thread" : "", m, lo, hi, one / m
        }
    }' times >table.md
cat table.md
"$root/scripts/into_page.sh" scaling.sh "$page" <table.md
