// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads a transform (.h5) or a field with ITK compiled for JavaScript, and writes its grid as JSON and its numbers beside.
//
//   node read_itk_wasm.mjs FOLDER FILE OUT.json     FOLDER: node_modules is in it or above it
import { createRequire } from "node:module";
import { writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [folder, file, out] = process.argv.slice(2);
const require = createRequire(folder + "/");
const load = (name) => import(pathToFileURL(require.resolve(name)));

async function grid() {
  if (file.endsWith(".h5")) {
    const { readTransformNode } = await load("@itk-wasm/transform-io");
    const [transform] = await readTransformNode(file);
    const fixed = Array.from(transform.fixedParameters);
    return { size: fixed.slice(0, 3), origin: fixed.slice(3, 6), spacing: fixed.slice(6, 9), direction: fixed.slice(9, 18), values: transform.parameters };
  }
  const { readImageNode } = await load("@itk-wasm/image-io");
  const image = await readImageNode(file);
  return { size: image.size, origin: image.origin, spacing: image.spacing, direction: Array.from(image.direction), values: image.data };
}

const { values, ...about } = await grid();
writeFileSync(out, JSON.stringify(about));
writeFileSync(out + ".values", Buffer.from(Float64Array.from(values).buffer));
