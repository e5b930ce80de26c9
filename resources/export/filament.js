// SPDX-License-Identifier: MIT
// Lights a Filament scene with the mean light of a grid that Limn exported. Filament's own tools read the text file, too.
//
//     import { limnIndirectLight } from './ROOM-filament.js';
//     scene.setIndirectLight(limnIndirectLight(Filament, engine, await (await fetch('ROOM.txt')).text()));
//
// In C++: IndirectLight::Builder().irradiance(3, sh).intensity(1).build(engine), where sh holds the file's nine colours.

/** The 27 numbers of the file. */
export function limnHarmonics(text) {
    const colours = [...text.matchAll(/\(([^)]*)\)/g)].map(([, inner]) => inner.split(',').map(Number));
    if (colours.length !== 9 || colours.flat().some((v) => !Number.isFinite(v))) throw new Error('not nine colours');
    return new Float32Array(colours.flat());
}

/** `intensity` scales the light; with 1 the scene's exposure must suit Limn's units. */
export function limnIndirectLight(Filament, engine, text, intensity = 1) {
    return Filament.IndirectLight.Builder().irradianceSh(3, limnHarmonics(text)).intensity(intensity).build(engine);
}
