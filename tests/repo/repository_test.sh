#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# repository_test.sh RULE [ARGUMENT]: prints what breaks the rule and exits 1, or exits 0 in silence.
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

# The rooms as their CMakeLists.txt say: "room FOLDER TARGET", "private FOLDER" and "edge TARGET TARGET", a line each.
declared_rooms() {
    files '^(engine|editor_ui)/(.*/)?CMakeLists\.txt$' | xargs awk '
        FNR == 1 { inside = 0; folder = FILENAME; sub(/\/CMakeLists\.txt$/, "", folder) }
        { gsub(/[()]/, " & ") }
        {
            for (i = 1; i <= NF; i++)
                if ($i == "limn_room") { inside = 1; room = list = "" }
                else if ($i == ")") inside = 0
                else if (inside && $i != "(") {
                    if (room == "") { room = $i; print "room", folder, room }
                    else if ($i ~ /^(SOURCES|PRIVATE_FOLDERS|DEPENDS)$/) list = $i
                    else if (list == "DEPENDS" && $i ~ /^limn_/) print "edge", room, $i
                    else if (list == "PRIVATE_FOLDERS") print "private", folder "/" $i
                }
        }'
}

# The same with app, which may include every room, and "reach TARGET TARGET" for what follows from the edges.
rooms_and_reach() {
    {
        declared_rooms
        echo "room app limn_app"
        declared_rooms | awk '$1 == "room" { print "edge limn_app", $3 }'
    } | awk '
        { print }
        $1 == "room" { rooms[++n] = $3 }
        $1 == "edge" { reach[$2, $3] = 1 }
        END {
            for (k = 1; k <= n; k++)
                for (i = 1; i <= n; i++)
                    for (j = 1; j <= n; j++)
                        if (reach[rooms[i], rooms[k]] && reach[rooms[k], rooms[j]]) reach[rooms[i], rooms[j]] = 1
            for (i = 1; i <= n; i++)
                for (j = 1; j <= n; j++)
                    if (reach[rooms[i], rooms[j]]) print "reach", rooms[i], rooms[j]
        }'
}

# A line for each room and each room that it may include, itself among them: what its CMake target depends on, and what that does.
may_include() {
    rooms_and_reach | awk '
        $1 == "room" { folder[$3] = $2; print $2, $2 }
        $1 == "reach" { print folder[$2], folder[$3] }'
}

# The tiers of the drawing of rooms, from the top down: a title, a colon and the tier's rooms, by their targets without "limn_".
# A new room needs a place in one of these lines and a row in a table of docs/architecture.md.
tiers_of_rooms='
Program: app editor_ui
Vulkan device: device_techniques gpu illuminance_gpu light_skin_gpu lpv_gpu photon_lattices_gpu probes_gpu radiance_volumes_gpu render rsm_gpu sparse_probes_gpu
Pictures, measures and exports: export final_lightmap illuminance_measure illuminance_stress lint measure picture reference
Techniques of bounced light: ambient illuminance illuminance_bake illuminance_format illuminance_overlay illuminance_relight illuminance_transport light_skin lpv photon_lattices probes radiance_volumes sparse_probes techniques
Light in a scene: field lattice lighting lightmap lightmap_layout rsm shading trace
Scenes and ground: core files gallery gltf json math overlay runtime scene stages
'
# The same as lines "title TIER TITLE" and "tier TIER TARGET", tiers being numbered from the top.
room_tiers() {
    awk -F ': *' 'NF == 2 {
        print "title", ++tier, $1
        n = split($2, rooms, " ")
        for (i = 1; i <= n; i++) print "tier", tier, "limn_" rooms[i]
    }' <<<"$tiers_of_rooms"
}

# Every room lies in one tier, and depends on rooms of its own tier and of lower ones only.
rooms_lie_in_tiers() {
    { room_tiers; rooms_and_reach; } | awk -v script=tests/repo/repository_test.sh '
        function short(target) { sub(/^limn_/, "", target); return target }
        $1 == "title" { number = $2; sub(/^[^ ]+ [^ ]+ /, ""); title[number] = $0; next }
        $1 == "tier" {
            if ($3 in tier) { print script ": tiers_of_rooms names " short($3) " twice"; bad = 1 }
            tier[$3] = $2
        }
        $1 == "room" {
            known[$3]
            if (!($3 in tier)) {
                print $2 ": in no tier: add " short($3) " to a line of tiers_of_rooms in " script
                bad = 1
            }
        }
        $1 == "edge" && ($2 in tier) && ($3 in tier) && tier[$2] > tier[$3] {
            print short($2) " (" title[tier[$2]] ") depends on " short($3) ", which lies in a higher tier (" title[tier[$3]] \
                "): move one of them in tiers_of_rooms in " script ", or what " short($2) " needs to a lower room"
            bad = 1
        }
        END {
            for (target in tier)
                if (!(target in known)) { print script ": tiers_of_rooms names " short(target) ", which is no room"; bad = 1 }
            exit bad
        }'
}

# The rooms in their tiers and their edges, those that follow from others left out, as docs/architecture.md shows them. Edges within
# a tier are arrows; what a room needs of lower tiers is named below it, so that the tiers stack.
rooms_drawing() {
    echo '```mermaid'
    echo 'flowchart TD'
    { rooms_and_reach; room_tiers; } | awk '
        function short(target) { sub(/^limn_/, "", target); return target }
        # The label of a room: its folder, and the rooms of lower tiers that it needs.
        function label(room,    text, lower, i) {
            for (i = 1; i <= n; i++)
                if (edge[room, rooms[i]] && tier[rooms[i]] != tier[room]) lower = lower (lower ? ", " : "") name[rooms[i]]
            text = name[room] (lower ? "<br>→ " lower : "")
            return text == short(room) ? text : short(room) "[\"" text "\"]"
        }
        $1 == "room" { rooms[++n] = $3; name[$3] = $2; sub(/^engine\//, "", name[$3]); sub(/^techniques\//, "", name[$3]) }
        $1 == "edge" { edge[$2, $3] = 1 }
        $1 == "reach" { reach[$2, $3] = 1 }
        $1 == "title" { tiers = $2; sub(/^[^ ]+ [^ ]+ /, ""); title[tiers] = $0 }
        $1 == "tier" { tier[$3] = $2; rooms_of[$2, ++count[$2]] = $3 }
        END {
            for (i = 1; i <= n; i++)
                for (j = 1; j <= n; j++)
                    for (k = 1; k <= n; k++)
                        if (edge[rooms[i], rooms[k]] && reach[rooms[k], rooms[j]]) implied[rooms[i], rooms[j]] = 1
            for (pair in implied) delete edge[pair]
            for (t = 1; t <= tiers; t++) {
                print "    subgraph tier" t "[\"" title[t] "\"]"
                print "        direction TB"
                for (i = 1; i <= count[t]; i++) print "        " label(rooms_of[t, i])
                for (i = 1; i <= count[t]; i++)
                    for (j = 1; j <= count[t]; j++)
                        if (edge[rooms_of[t, i], rooms_of[t, j]]) print "        " short(rooms_of[t, i]) " --> " short(rooms_of[t, j])
                print "    end"
                if (t > 1) print "    tier" t - 1 " --> tier" t
            }
        }'
    echo '```'
}
# A drawing that is committed goes stale, unless something compares it.
drawing_of_rooms_is_current() {
    rooms_lie_in_tiers || return 1
    diff <(sed -n '/^```mermaid$/,/^```$/p' docs/architecture.md) <(rooms_drawing) ||
        { echo "docs/architecture.md: its drawing is not what tests/repo/repository_test.sh rooms_drawing prints"; return 1; }
}

# The tables of rooms in docs/architecture.md have a row for each room, and none for a room that is gone.
rooms_are_described() {
    diff <(rooms_and_reach | awk '$1 == "room" { print $2 "/" }' | sort) \
        <(sed -nE 's/^\| `(app|editor_ui|engine)(.*\/)` \|.*/\1\2/p' docs/architecture.md | sort) ||
        { echo "docs/architecture.md: its tables of rooms need a row for each folder marked <, and none for those marked >"; return 1; }
}

layers_point_downward() {
    local allowed private
    allowed=$(may_include)
    private=$(declared_rooms | awk '$1 == "private" { print $2 }')
    awk '$1 != $2 && ($2, $1) in seen { print $1 " and " $2 " depend on each other"; bad = 1 } { seen[$1, $2] } END { exit bad }' \
        <<<"$allowed"
    files "^(engine|editor_ui|app)/.*$cpp" | xargs awk -v allowed="$allowed" -v private="$private" '
        # The innermost folder above the file that is a room.
        function room(path) {
            while (sub(/\/[^\/]*$/, "", path))
                if (path in known) return path
            return ""
        }
        # Rooms of one technique are one house.
        function house(folder, part) {
            split(folder, part, "/")
            return part[2] == "techniques" ? part[1] "/" part[2] "/" part[3] : folder
        }
        function folder(path) { sub(/\/[^\/]*$/, "", path); return path }
        BEGIN {
            n = split(allowed, pair, "\n")
            for (i = 1; i <= n; i++) { split(pair[i], ends, " "); may[ends[1], ends[2]]; known[ends[1]] }
            n = split(private, list, "\n")
            for (i = 1; i <= n; i++) hidden[list[i]]
        }
        FNR == 1 && !room(FILENAME) { print FILENAME ": in no known room"; bad = 1 }
        match($0, /^ *# *include *"[^"]+"/) {
            split($0, quoted, "\"")
            if (quoted[2] ~ /^shaders\//) next
            from = room(FILENAME)
            target = room(quoted[2])
            if (!target) { print FILENAME ":" FNR ": include by the path from the root: " quoted[2]; bad = 1 }
            else if (!((from, target) in may)) {
                print FILENAME ":" FNR ": its target does not depend on that of " quoted[2]; bad = 1
            }
            else if (folder(quoted[2]) in hidden && house(from) != house(target)) {
                print FILENAME ":" FNR ": private to " target ": " quoted[2]; bad = 1
            }
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
# Of the engine, what does not depend on its gpu builds without a driver.
light_knows_no_vulkan() {
    local light
    light=$(may_include | awk '$2 == "engine/gpu" { gpu[$1] } { room[$1] } END { for (r in room) if (!(r in gpu)) print r }' |
        grep '^engine/' | paste -sd '|')
    includes_none "^($light)/" '(vulkan|volk)'
}

# The editor, the program and explanations know techniques by their tables; what needs more lies in the technique's part of the program.
techniques_are_known_by_their_tables() {
    ! files "^(editor_ui|app|engine/picture)/.*$cpp" | grep -v '^app/techniques/' |
        xargs grep -nE '^ *# *include *"(engine|app)/techniques/[a-z_]+/' | grep -v '"engine/techniques/device/'
}

# Two types of one name in one namespace are undefined behaviour where both reach a program, and no linker says so.
types_have_one_definition() {
    files '^(engine|editor_ui|app)/.*\.h$' | xargs awk '
        FNR == 1 { space = "" }
        /^namespace [a-z:]+ \{/ { space = $2 }
        /^(struct|class) [A-Z][A-Za-z0-9]* *(final *)?(:|\{)/ {
            name = $2
            sub(/[:{].*/, "", name)
            key = space "::" name
            if (key in where && where[key] != FILENAME) { print FILENAME ": " key " is also in " where[key]; bad = 1 }
            where[key] = FILENAME
        }
        END { exit bad }'
}

files_have_a_licence_line() {
    files "$code|\.sh$|^run$|^check$|^\.ci/" | xargs awk '
        function missing() { if (name != "" && !found) { print name ": no licence line"; bad = 1 } }
        FNR == 1 { missing(); name = FILENAME; found = 0 }
        /SPDX-License-Identifier: MIT/ { found = 1 }
        FNR == 2 { nextfile }
        END { missing(); exit bad }'
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

# A header compiles alone if a source includes nothing before it.
sources_include_theirs_first() {
    local bad=0 source own
    while read -r source; do
        own=${source%.cpp}.h
        [ -e "$own" ] || continue
        [ "$(grep -m 1 -oE '^ *# *include *[<"][^>"]+' "$source" | sed 's/.*[<"]//')" = "$own" ] ||
            { echo "$source: includes something before $own"; bad=1; }
    done < <(files '^(engine|editor_ui|app)/.*\.cpp$')
    return $bad
}

# Paths of one machine; written in two parts here so that this line is not one of them.
names_no_machine_path() {
    ! files '\.(cpp|h|glsl|vert|frag|comp|sh|md|txt|cmake|json|gltf|limn)$|^run$|^check$|^\.ci/' |
        xargs grep -nE "(^|[^A-Za-z0-9_.-])/(wo""rk|tm""p|ro""ot|ho""me)/"
}

# Relative links and pictures of every page lead to files of the repository and to headings in them.
links_lead_somewhere() {
    files | python3 tests/repo/markdown_links.py
}

# Two screens: what a stranger needs first. The rest has its own pages in docs/.
readme_is_short() {
    local size
    size=$(wc -c <README.md)
    [ "$size" -le 8192 ] || { echo "README.md: $size bytes, more than 8192: move something to a page in docs/"; return 1; }
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

# A reader that ends early kills the command that still writes to it, and with pipefail that is a failure, now and then.
pipes_are_read_to_their_end() {
    ! files '\.sh$|^run$|^check$|^\.ci/' | xargs grep -nE '\| *(head|grep +-[a-zA-Z]*[qm])'
}

# The scripts that no test runs still name targets: those are in the build folder $1.
scripts_build_what_exists() {
    local bad=0 target
    for target in $(files '\.sh$|^run$' | xargs sed -n 's/^ *\.ci\/build release //p'); do
        ninja -C "$1" -t query "$target" >/dev/null 2>&1 || { echo "no target $target"; bad=1; }
    done
    return $bad
}

format() {
    files "$cpp" | xargs --max-procs=2 --max-args=20 clang-format --dry-run --Werror
}

"$@"
