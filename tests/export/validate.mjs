// SPDX-License-Identifier: MIT
// node validate.mjs FILE...: the Khronos validator; 1 if it finds errors.
import fs from 'node:fs';
import path from 'node:path';
import validator from 'gltf-validator';

let errors = 0, warnings = 0;
const files = process.argv.slice(2);
for (const file of files) {
    const beside = async (uri) => new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))));
    const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)),
        { uri: path.basename(file), maxIssues: 20, externalResourceFunction: beside });
    errors += issues.numErrors;
    warnings += issues.numWarnings;
    for (const { severity, code, message, pointer } of issues.messages)
        if (severity < 2) console.log(`${path.basename(file)}: ${code} at ${pointer}: ${message}`);
}
console.log(`glTF validator: ${files.length} files, ${errors} errors, ${warnings} warnings`);
process.exit(errors > 0 ? 1 : 0);
