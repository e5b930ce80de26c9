#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# repository_test.sh RULE: prints what breaks the rule and exits 1, or exits 0 in silence.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# Every file of the repository, or those whose path matches a pattern.
files() {
    local list
    if ! list=$(git ls-files --cached --others --exclude-standard 2>/dev/null); then
        list=$(find . -type f -not -path './build/*' -not -path './.git/*' -printf '%P\n')
    fi
    # A file can be listed and gone at once, while a change is being made.
    grep -E "${1:-.}" <<<"$list" | sort | while read -r file; do [ -e "$file" ] && echo "$file"; done
}
cpp='\.(cpp|h)$'
code='\.(cpp|h|glsl|vert|frag|comp)$'

# Rooms from the bottom up: a room includes itself and the rooms before it.
rooms='engine/core engine/math engine/scene engine/gallery engine/trace engine/reference engine/bake engine/overlay engine/relight
       engine/files engine/measure engine/stress engine/gpu engine/relight_gpu engine/render editor_ui app'

layers_point_downward() {
    files "^(engine|editor_ui|app)/.*$cpp" | xargs awk -v rooms="$rooms" '
        function room(path, part) {
            split(path, part, "/")
            return part[1] == "engine" ? part[1] "/" part[2] : part[1]
        }
        BEGIN { n = split(rooms, list); for (i = 1; i <= n; i++) rank[list[i]] = i }
        FNR == 1 && !(room(FILENAME) in rank) { print FILENAME ": in no known room"; bad = 1 }
        match($0, /^ *# *include *"[^"]+"/) {
            split($0, quoted, "\"")
            target = room(quoted[2])
            if (target == "shaders") next
            if (!(target in rank)) { print FILENAME ":" FNR ": include by the path from the root: " quoted[2]; bad = 1 }
            else if (rank[target] > rank[room(FILENAME)]) { print FILENAME ":" FNR ": includes upward: " quoted[2]; bad = 1 }
        }
        END { exit bad }'
}

# includes_none WHERE WHAT: no file under WHERE includes a header that matches WHAT.
includes_none() {
    ! files "$1.*$cpp" | xargs grep -nE "^ *# *include *[<\"]($2)"
}
engine_knows_no_window() {
    includes_none '^(engine|projects)/' '(imgui|GLFW|editor_ui|app/)'
}
light_knows_no_vulkan() {
    includes_none '^engine/(core|math|scene|gallery|trace|bake|overlay|relight|reference|files|measure|stress)/' \
        '(vulkan|volk|engine/(gpu|render|relight_gpu))'
}

files_have_a_licence_line() {
    local bad=0
    while read -r file; do
        head -n 2 "$file" | grep -q 'SPDX-License-Identifier: MIT' || { echo "$file: no licence line"; bad=1; }
    done < <(files "$code|\.sh$|^run$|^check$|^\.ci/")
    return $bad
}

files_stay_small() {
    files "$code" | xargs awk '
        function report(limit) { if (lines > limit) { print last ": " lines " lines, more than " limit; bad = 1 } }
        function limit_of(path) {
            if (path ~ /^tests\/.*\.h$/) return 300 # these hold code
            return path ~ /main\.cpp$/ || path ~ /\.h$/ ? 150 : 600
        }
        FNR == 1 { if (last) report(limit_of(last)); last = FILENAME }
        { lines = FNR }
        END { report(limit_of(last)); exit bad }'
}

# Paths of one machine; written in two parts here so that this line is not one of them.
names_no_machine_path() {
    ! files '\.(cpp|h|glsl|vert|frag|comp|sh|md|txt|cmake|json|gltf|limn)$|^run$|^check$|^\.ci/' |
        xargs grep -nE "(^|[^A-Za-z0-9_.-])/(wo""rk|tm""p|ro""ot|ho""me)/"
}

shell_scripts_parse() {
    local bad=0
    while read -r file; do
        bash -n "$file" || bad=1
        [ -x "$file" ] || { echo "$file: not executable"; bad=1; }
        grep -q '^set -euo pipefail' "$file" || { echo "$file: no set -euo pipefail"; bad=1; }
    done < <(files '\.sh$|^run$|^check$|^\.ci/')
    return $bad
}

format() {
    files "$cpp" | xargs --max-procs=2 --max-args=20 clang-format --dry-run --Werror
}

"$1"
