#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# docs/gallery.sh: renders the pictures of docs/gallery, those of the README and of other pages among them, and writes the page docs/gallery.md that
# shows them. Pictures of the editor's window need Xvfb and xdotool. Takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

.ci/install build test
.ci/build release limn journeys
limn=build/release/limn
out=docs/gallery
page=docs/gallery.md
work=build/gallery
mkdir -p "$out" "$work"
rm -f "$out"/*.png

say() { printf '%s\n' "$@" >>"$page"; }
section() { say "" "## $1" "" "$2" ""; }
# show NAME CAPTION: adds a picture to the page.
show() {
    say "![$2]($(basename "$out")/$1.png)" "" "*$2*" ""
}
# render NAME CAPTION LIMN_RENDER_ARGUMENT...: draws a picture and adds it to the page.
render() {
    "$limn" render "${@:3}" -o "$out/$1.png" >"$work/$1.txt"
    show "$1" "$2"
}
bake() { [ -e "$work/$1.limnbake" ] || "$limn" bake "$1" -o "$work/$1.limnbake" >"$work/$1-bake.txt"; }

cat >"$page" <<'PAGE'
# Gallery

`docs/gallery.sh` renders every picture of this page and writes the page itself. Nothing here is edited by hand.
PAGE

wide=(--width 640 --height 360)
square=(--width 400 --height 400)
bake cornell
bake atrium
cornell=(cornell --bake "$work/cornell.limnbake" "${square[@]}")
atrium=(atrium --bake "$work/atrium.limnbake" "${wide[@]}")

section "Light" "One bake serves all lights: moving, colouring or adding one needs no new bake."
render atrium "The sample \"atrium\", lit by one sun" "${atrium[@]}"
render atrium-indirect "Its bounced light alone" "${atrium[@]}" --view indirect
render cornell "The sample \"cornell\"" "${cornell[@]}"
render cornell-blue "A blue lamp in front of the blocks, with the same bake" "${cornell[@]}" \
    --light 'point pos=-1,4,1 cd=20 color=0.3,0.5,1'

section "Why a spot is lit" "\`limn render --overlay\` and the editor's list of overlays show what a bake is made of."
render surfels "Surfels, the samples of surfaces that send light, in their albedo" "${cornell[@]}" --overlay surfels
render clusters "Clusters of surfels, six steps below the root of their tree" "${cornell[@]}" --overlay clusters --overlay-depth 6
render links "The link cut of one cache on the floor: surfels by the weight of the cluster that it is linked with" \
    "${cornell[@]}" --overlay links --pick 60,370
render dependencies "What lights the tall block: surfels by their object's share of its bounced light" \
    "${cornell[@]}" --overlay dependencies --pick 150,220
render caches "Caches, where light is gathered: texels of the lightmap and cells of the grid" "${cornell[@]}" --overlay caches
render density "Texels per metre" "${atrium[@]}" --overlay density
render charts "Charts of the lightmap" "${atrium[@]}" --overlay charts
render lit-surfels "What surfels send" "${cornell[@]}" --overlay lit-surfels
render lobes "Light that reaches the caches from each side, in its own colour" "${cornell[@]}" --overlay lobes
render wireframe "The edges of all triangles" "${atrium[@]}" --inspect wireframe

section "Measured" "The reference is a path tracer ([what it shares](architecture.md#what-the-reference-shares) with the pictures); figures are free of its noise."
exr=("${square[@]}" --view lit)
"$limn" render cornell --bake "$work/cornell.limnbake" "${exr[@]}" -o "$work/test.exr" >"$work/test.txt"
for seed in 1 2; do
    "$limn" reference cornell "${exr[@]}" --spp 256 --seed "$seed" -o "$work/truth$seed.exr" >"$work/truth$seed.txt"
done
"$limn" compare "$work/test.exr" "$work/truth1.exr" --reference2 "$work/truth2.exr" --heatmap "$out/error.png" | tee "$work/compare.txt"
show error "The signed error of \"cornell\": blue is too dark, orange too bright, saturated at 50 %"
say '```' "$(cut -d: -f2- "$work/compare.txt" | sed 's/^ *//')" '```'

section "Rivals" "The same scene, lights and shadow maps, lit by other techniques of the literature."
render lpv "Light propagation volumes" cornell "${square[@]}" --technique lpv
render lpv-lobes "Their lattice's cells: direction and colour of the light" cornell "${square[@]}" --technique lpv --overlay lpv-lobes
render probes "Light field probes" cornell "${square[@]}" --technique probes
render probe-balls "Their probes, as balls in the light that reaches them" cornell "${square[@]}" --technique probes --overlay probes
render sparse-probes "Sparse radiance probes" cornell "${square[@]}" --technique sparse-probes
render lpv-leak "Irradiance in a sealed dark room: light propagation volumes carry it through the wall" generated:23 "${wide[@]}" \
    --camera "Dark room" --technique lpv --view irradiance
render lpv-cells "Irradiance by a lattice of 8 cells a side: patches on walls and ceiling have the size of its cells" cornell \
    "${square[@]}" --technique lpv --set lpv.resolution=8 --set lpv.rounds=16 --view irradiance
render probes-dark "Irradiance by light field probes: passages whose probes stand in the court are nearly black" atrium "${wide[@]}" \
    --technique probes --view irradiance
render probes-ring "Probes whose harmonics ring: magenta sides would get less than no light" atrium "${wide[@]}" --technique probes \
    --overlay probes

render lpv-arrival "Rounds until light arrives before each surface: yellow ones are lit at once, violet ones after 16 rounds, grey ones never" \
    cornell "${square[@]}" --technique lpv --overlay lpv-arrival
render probe-reflections "Reflections marched from what one probe sees: teal ones meet a surface, magenta ones are unknown" cornell "${square[@]}" \
    --technique probes --overlay probe-reflections --pick 200,270
render sparse-negative "Texels to which few bands of harmonics bring less than no light are magenta" cornell "${square[@]}" \
    --technique sparse-probes --overlay sparse-negative

lamp=(--light 'rect pos=0,5.4,0 size=1.3,1 nits=20')
on_cpu=(--device cpu --gather-rays 0 --near-rays 0 --spp 16)
render photon-caustics "Caustics of a ring of metal and a ball of glass, by a million photons in lattices" caustics "${wide[@]}" \
    --technique photon-lattices --set photon-lattices.photons=1000000 "${on_cpu[@]}"
render photon-cells "Irradiance by photon lattices without a blur: the cells of the coarse lattices show" cornell "${square[@]}" "${lamp[@]}" \
    --technique photon-lattices --set photon-lattices.blur=0 --view irradiance "${on_cpu[@]}"
render photons "Stored photons, by what they did last" caustics "${wide[@]}" --technique photon-lattices --overlay photons
render skin-street "A street in the sun by LightSkin: coloured planes light the houses opposite" generated:coloured-street "${wide[@]}" \
    --technique light-skin "${on_cpu[@]}"
render skin-caches "Light caches of LightSkin, as discs of the area that each stands for" cornell "${square[@]}" "${lamp[@]}" \
    --technique light-skin --overlay skin-caches
render skin-leak "Irradiance in a sealed dark room: proxy lights of LightSkin shine through the wall" generated:23 "${wide[@]}" \
    --camera "Dark room" --technique light-skin --view irradiance "${on_cpu[@]}"
render volume-caches "Caches of dynamic radiance volumes, by grid: they lie around what the view shows" cornell "${square[@]}" "${lamp[@]}" \
    --technique radiance-volumes --overlay volume-caches
render volume-shadow "Irradiance by dynamic radiance volumes with the published cones, which the sender's own wall darkens" cornell \
    "${square[@]}" "${lamp[@]}" --technique radiance-volumes --set radiance-volumes.shadow=2 --view irradiance "${on_cpu[@]}"

# Cornell with a floor of rough metal, without its panel and its short block.
cp projects/cornell/cornell.bin "$work"
sed -e '/"name":"cornell","nodes"/s/5,6,7,8/6,8/' -e '/"name":"Floor","primitives"/s/"material":0/"material":4/' \
    -e '/{"name":"Panel","pbr/s|$|,{"name":"Metal","pbrMetallicRoughness":{"baseColorFactor":[0.8,0.8,0.8,1],"roughnessFactor":0.3}}|' \
    projects/cornell/cornell.gltf >"$work/polished.gltf"
floor=("$work/polished.gltf" --light 'spot pos=0,4.5,2.6 dir=0,0.2,-1 inner=35 outer=45 cd=40' --eye 0.6,4.4,4.6 --target 0.2,0.2,0 --fov 66
    --width 240 --height 200 --exposure 2)
render volume-floor "A floor of metal reflects the maps of radiance volumes, with lobes as published" "${floor[@]}" --technique radiance-volumes \
    --set radiance-volumes.glossy=1 "${on_cpu[@]}"
render volume-floor-microfacet "The same with lobes of a microfacet model" "${floor[@]}" --technique radiance-volumes \
    --set radiance-volumes.glossy=2 "${on_cpu[@]}"
"$limn" reference "${floor[@]}" --bounces 1 --spp 512 -o "$out/volume-floor-reference.png" >"$work/volume-floor-reference.txt"
show volume-floor-reference "The same path-traced, with one bounce"

section "The editor" "[The editor](editor.md) says how to work with it."
build/release/journeys --gtest_filter='Gallery.*'
cp build/journeys/GalleryOfWindows/*.png "$out/"
show editor "The workspace Light on the sample \"atrium\""
show explain "What a spot's light is made of: the table sums to all of it"
show compare "The path-traced picture beside Limn's, with their error"
