// SPDX-License-Identifier: GPL-3.0-or-later
//
// What viewer.js knows of the run: the page's arrays, as viewer_data.cpp packed them, and the words for a place.
// Places and displacements are in LPS, mm.
const element = (id) => document.getElementById(id);
const length = (v) => Math.hypot(...v);
const difference = (a, b) => a.map((x, axis) => x - b[axis]);
const clamped = (x, low, high) => Math.max(low, Math.min(high, x));

// --- Unpacking ---

async function unpacked(id) {
  const text = element(id).textContent;
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const format = text.startsWith("H4sI") ? "gzip" : "deflate"; // what gzip's first bytes look like
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream(format))).arrayBuffer();
}
const unpackedText = async (id) => new TextDecoder().decode(await unpacked(id));
const numbers = async (id, Type) => new Type(await unpacked(id));

// An object for each row, its numbers by the names of their columns.
function records(csv) {
  const lines = csv.trim().split("\n").filter((line) => !line.startsWith("#"));
  const [names, ...rows] = lines.map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(names.map((name, i) => [name, Number(row[i])])));
}

// --- Fields on grids ---

const transformed = (m, [x, y, z]) =>
  [0, 4, 8].map((row) => m[row] * x + m[row + 1] * y + m[row + 2] * z + m[row + 3]);

// Linear between the voxels; beyond the grid as at its border. Called millions of times: no array is made here.
function valueAt(grid, values, place, component = 0) {
  const [nx, ny, nz] = grid.size;
  const m = grid.to_index, [px, py, pz] = place;
  const x = clamped(m[0] * px + m[1] * py + m[2] * pz + m[3], 0, nx - 1);
  const y = clamped(m[4] * px + m[5] * py + m[6] * pz + m[7], 0, ny - 1);
  const z = clamped(m[8] * px + m[9] * py + m[10] * pz + m[11], 0, nz - 1);
  const i = Math.min(nx - 2, Math.floor(x)), j = Math.min(ny - 2, Math.floor(y)), k = Math.min(nz - 2, Math.floor(z));
  const a = x - i, b = y - j, c = z - k;
  const first = i + nx * (j + ny * (k + nz * component));
  const along = (from) => values[from] * (1 - a) + values[from + 1] * a;
  const layer = (from) => along(from) * (1 - b) + along(from + nx) * b;
  return layer(first) * (1 - c) + layer(first + nx * ny) * c;
}

function nearest(grid, values, place) {
  const index = transformed(grid.to_index, place).map(Math.round);
  const [i, j, k] = index.map((x, axis) => clamped(x, 0, grid.size[axis] - 1));
  return values[i + grid.size[0] * (j + grid.size[1] * k)];
}

// --- The run ---

async function unpackedRun(facts) {
  const displacement = await numbers("displacement", Int16Array);
  const brain = await numbers("brain", Uint8Array);
  return {
    ...facts, brain, kinds: await kindsOfColours(facts.steps, brain, displacement, facts),
    displacementAt: (place) =>
      [0, 1, 2].map((axis) => facts.steps.displacement * valueAt(facts.fields, displacement, place, axis)),
    image: await numbers("image", Uint8Array), change: await numbers("image_change", Uint8Array),
    labels: element("labels") ? [await numbers("labels", Uint16Array), await numbers("labels_after", Uint16Array)] : [],
    vertices: await numbers("vertices", Float32Array), triangles: await numbers("triangles", Uint32Array),
    measured: records(facts.load).map((row) => ({
      at: [row.x, row.y, row.z], shift: [row.ux, row.uy, row.uz],
      deviation: row.sigma_x && length([row.sigma_x, row.sigma_y, row.sigma_z]) / Math.sqrt(3),
    })),
    landmarks: records(facts.uncertainty).filter((row) => row.xx > 0).map((row) => ({
      at: [row.x, row.y, row.z], deviation: Math.sqrt(row.xx + row.yy + row.zz),
    })),
  };
}

// What may be shown as colours: values on the grid of the fields, the one where nothing happens, and what a click says.
async function kindsOfColours(steps, brain, displacement, { largest, sequential, diverging }) {
  const scaled = async (name) => Float32Array.from(await numbers(name, Int16Array), (value) => value * steps[name]);
  const almostMost = (values) => { // 99 % of the brain have less
    const inside = values.filter((_, voxel) => brain[voxel]).sort();
    return Number(inside[Math.floor(0.99 * (inside.length - 1))].toPrecision(1));
  };
  const part = (voxel, axis) => displacement[voxel + axis * brain.length];
  const lengths = Float32Array.from(brain, (_, voxel) =>
    steps.displacement * Math.hypot(part(voxel, 0), part(voxel, 1), part(voxel, 2)));
  const shift = { unit: "mm", low: 0, neutral: 0, colours: sequential };
  const kinds = [{ name: "none" }, { ...shift, name: "displacement", high: largest, values: lengths }];
  if (steps.error) {
    const values = await scaled("error");
    const says = (value) => `Estimated error of the computation: ${mm(value)}.`;
    kinds.push({ ...shift, name: "estimated error", high: almostMost(values) || 1, values, says });
  }
  if (steps.deviation) {
    const values = await scaled("deviation");
    const says = (value) => `The displacement may be off by \u00b1 ${mm(value)}.`;
    kinds.push({ ...shift, name: "uncertainty", high: almostMost(values) || 1, values, says });
  }
  if (steps.ratio) {
    const values = await scaled("ratio");
    const reach = Math.max(0.02, almostMost(values.map((value) => Math.abs(value - 1))));
    const says = (value) => `Its volume becomes ${value.toFixed(3)} of what it was.`;
    const range = { unit: "", low: 1 - reach, high: 1 + reach, neutral: 1 };
    kinds.push({ ...range, name: "volume ratio", colours: diverging, values, says });
  }
  return kinds;
}

// Where the tissue was that now lies at a place: x + u(x) = place.
function cameFrom(run, place) {
  let x = place;
  for (let i = 0; i < 20; ++i) {
    const before = x;
    x = difference(place, run.displacementAt(x));
    if (Math.max(...difference(x, before).map(Math.abs)) < 0.01) break;
  }
  return x;
}

// Where each voxel's tissue was; kept, as it takes long.
function sourcesOf(run) {
  const [nx, ny] = run.fields.size;
  const centre = (v) => transformed(run.fields.to_world, [v % nx, Math.floor(v / nx) % ny, Math.floor(v / (nx * ny))]);
  run.sources ??= Array.from(run.brain, (_, voxel) => cameFrom(run, centre(voxel)));
  return run.sources;
}

// --- What a click says ---

const mm = (value) => `${value.toFixed(Math.abs(value) < 1 ? 2 : 1)} mm`;

const directions = (u) => [["to the left", "to the right"], ["backwards", "forwards"], ["up", "down"]]
  .map(([plus, minus], axis) => `${mm(Math.abs(u[axis]))} ${u[axis] < 0 ? minus : plus}`).join(", ");

const labelAt = (run, source) => run.labels.length > 0 && nearest(run.images, run.labels[0], source);

function isTakenOut(run, source) {
  const labels = run.options.resection?.labels.split(/[ ,]+/) ?? [];
  return labels.includes(String(labelAt(run, source)));
}

function wordsOfTissue(run, source, after) {
  if (!(valueAt(run.fields, run.brain, source) > 0)) return ["outside the brain, where nothing is predicted."];
  if (isTakenOut(run, source)) return ["what lay here is taken out."];
  const u = run.displacementAt(source);
  const tissue = after ? "the tissue that lies here came" : "the tissue here moves"; // that of its surface, too
  return [`${tissue} ${mm(length(u))}: ${directions(u)}.`,
    ...run.kinds.filter((kind) => kind.says).map((kind) => kind.says(valueAt(run.fields, kind.values, source)))];
}

function wordsOfLabel(run, source) {
  const label = labelAt(run, source);
  const name = run.label_names[label];
  return label ? [`label ${label}${name ? ` (${name})` : ""}.`] : [];
}

function nearestPoint(points, place) {
  const near = points.map((point) => ({ ...point, far: length(difference(point.at, place)) }));
  return near.filter(({ far }) => far < 20).sort((a, b) => a.far - b.far)[0];
}

function wordsOfPoints(run, source) {
  const parts = [];
  const landmark = nearestPoint(run.landmarks, source);
  if (landmark) {
    parts.push(`Standard deviation, at a landmark ${mm(landmark.far)} away: ${mm(landmark.deviation)}.`);
  }
  const near = nearestPoint(run.measured, source);
  if (near) {
    const computed = run.displacementAt(near.at);
    parts.push(`Nearest measured point, ${mm(near.far)} away: measured ${mm(length(near.shift))}`,
      near.deviation ? `(standard deviation ${mm(near.deviation)} along an axis),` : "and",
      `computed ${mm(length(computed))}; they differ by ${mm(length(difference(computed, near.shift)))}.`);
  }
  return parts;
}

function wordsOf(run, place, after) {
  const source = after ? cameFrom(run, place) : place;
  const where = `At ${place.map((x) => x.toFixed(1)).join(", ")} (LPS, mm), ${after ? "after" : "before"}:`;
  return [where, ...wordsOfTissue(run, source, after), ...wordsOfLabel(run, source), ...wordsOfPoints(run, source)]
    .join(" ");
}
