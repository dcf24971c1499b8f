// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the report that moves: curves of the solver (uPlot), and three planes with the
// brain in 3-D (NiiVue). page.cpp puts it at the end of the page, after viewer_run.js. NiiVue's places are in RAS;
// flipped() leads from LPS to them and back.

// --- Curves ---

// Rows come in the order of x. A line: its label, its column, its dashes. One without a positive value is left out, and
// a plot without lines.
function drawPlot(place, rows, title, [x, xLabel], yLabel, lines, { logarithmic = [], shaded = 0 } = {}) {
  const scale = (axis) => ({ time: false, distr: logarithmic.includes(axis) ? 3 : 1 });
  const plain = (_, ticks) => ticks.map((tick) => (tick === null ? "" : `${Number(tick.toPrecision(3))}`));
  const numbers = (axis) => (logarithmic.includes(axis) ? { values: plain } : {}); // uPlot's own are 0 below 0.001
  const shown = (y) => (Number.isFinite(y) && (!logarithmic.includes("y") || y > 0) ? y : null);
  const columns = lines.map(([, name]) => rows.map((row) => shown(row[name])));
  const drawn = lines.map((_, i) => i).filter((i) => columns[i].some((y) => y > 0));
  if (rows.length < 2 || drawn.length === 0) return;
  const colours = ["#145aaa", "#d25a14", "#288c3c", "#96288c"];
  const shade = (plot) => {
    const { left, top, height } = plot.bbox;
    plot.ctx.fillStyle = "#eef2f7";
    plot.ctx.fillRect(left, top, plot.valToPos(rows[shaded][x], "x", true) - left, height);
  };
  new uPlot({
    title, width: 560, height: 340, hooks: { drawClear: shaded > 0 ? [shade] : [] },
    scales: { x: scale("x"), y: scale("y") },
    axes: [{ label: xLabel, ...numbers("x") }, { label: yLabel, size: 70, ...numbers("y") }],
    series: [{ label: xLabel }, ...drawn.map((i, number) => {
      const [label, , dash] = lines[i];
      return { label, stroke: colours[number], width: 2, dash, points: { show: !dash, size: 5 } };
    })],
  }, [rows.map((row) => row[x]), ...drawn.map((i) => columns[i])], element(place));
}

// A motion in time converges to nothing; else time 1 is the end of loading.
function drawCurves(history, options) {
  const inTime = options.dynamics === "transient";
  const rows = records(history).map((row) => ({ ...row, tolerance: Number(options.tolerance) }));
  if (!inTime) {
    const shaded = rows.findIndex(({ time }) => time >= 1);
    drawPlot("curves", rows, shaded > 0 ? "Convergence (shaded: loading)" : "Convergence", ["step", "step"], "",
      [["bound of the remaining error, mm", "error_bound_mm"], ["residual / force", "residual"],
        ["tolerance, mm", "tolerance", [6, 4]]], { logarithmic: ["y"], shaded });
  }
  drawPlot("curves", rows, "Energies", inTime ? ["time", "time, s"] : ["step", "step"], "mJ",
    [["external work", "external_work_mJ"], ["strain energy", "strain_energy_mJ"],
      ["kinetic energy", "kinetic_energy_mJ"], ["dissipated", "dissipated_energy_mJ"]]);
}

// --- Colours ---

const flesh = [220, 200, 190], blue = [90, 200, 250], orange = [255, 150, 60];

// Evenly spaced colours, as NiiVue takes them.
const colourMap = (colours) => ({
  R: colours.map((c) => c[0]), G: colours.map((c) => c[1]), B: colours.map((c) => c[2]), A: colours.map(() => 255),
  I: colours.map((_, i) => Math.round((255 * i) / (colours.length - 1))),
});

const mixed = (a, b, share) => a.map((from, i) => from + (b[i] - from) * share);

function colourOf({ colours, low, high }, value) {
  const place = clamped((value - low) / (high - low), 0, 1) * (colours.length - 1);
  const below = Math.min(Math.floor(place), colours.length - 2);
  return mixed(colours[below], colours[below + 1], place - below);
}

// 0 where nothing happens, so that the image or the bare surface is seen.
const strength = (kind, value) => Math.min(1, 3 * Math.abs(value - kind.neutral) / (kind.high - kind.neutral));

// --- What NiiVue shows ---

const flipped = ([x, y, z]) => [-x, -y, z];

async function newView() {
  const nv = new niivue.Niivue({
    backColor: [0, 0, 0, 1], fontColor: [0.9, 0.9, 0.9, 1], crosshairColor: [0.3, 1, 0.4, 1], crosshairWidth: 0.4,
    crosshairGap: 8, show3Dcrosshair: true,
    isRadiologicalConvention: true, sagittalNoseLeft: true, isSliceMM: true, multiplanarForceRender: true,
    multiplanarShowRender: niivue.SHOW_RENDER.ALWAYS, multiplanarLayout: niivue.MULTIPLANAR_TYPE.GRID,
    meshThicknessOn2D: 0.7, dragAndDropEnabled: false, logLevel: "error",
  });
  await nv.attachToCanvas(element("canvas"));
  nv.drawImage3D = () => {}; // in 3-D the image's block would hide the surface
  return nv;
}

async function addVolume(nv, name, grid, values, options) {
  const m = [...grid.to_world.map((value, i) => (i < 8 ? -value : value)), 0, 0, 0, 1];
  const spacing = [0, 1, 2].map((axis) => Math.hypot(m[axis], m[axis + 4], m[axis + 8]));
  const type = values instanceof Float32Array ? 16 : 2; // NIfTI's numbers of float and of byte
  const bytes = niivue.NVImage.createNiftiArray(grid.size, spacing, m, type, values);
  const volume = await niivue.NVImage.loadFromFile({ file: new File([bytes], `${name}.nii`), name, ...options });
  nv.addVolume(volume);
  return volume;
}

// Colours, and their opacities.
async function addOverlay(nv, { fields, brain, kinds }) {
  const overlay = await addVolume(nv, "overlay", fields, new Float32Array(brain.length), {});
  const opacity = await addVolume(nv, "opacity", fields, new Float32Array(brain.length), { opacity: 0 });
  Object.assign(opacity, { cal_min: 0, cal_max: 1 });
  Object.assign(overlay, { modulationImage: nv.volumes.indexOf(opacity), modulateAlpha: 1 });
  for (const kind of kinds.slice(1)) nv.addColormap(kind.name, colourMap(kind.colours));
  return { overlay, opacity };
}

// NiiVue's palettes have 256 places: a label is shown by its place among those that there are.
async function addLabels(nv, { images, labels }) {
  const known = [...new Set(labels.flatMap((map) => [...new Set(map)]))].sort((a, b) => a - b);
  element("labels_shown").disabled = known.length < 2;
  if (known.length < 2) return {};
  const places = new Map(known.map((label, place) => [label, place]));
  const labelMaps = labels.map((map) => Uint8Array.from(map, (label) => places.get(label)));
  const labelVolume = await addVolume(nv, "labels", images, labelMaps[0], { opacity: 0 });
  const palette = [orange, [255, 80, 80], [80, 200, 255], [255, 210, 60], [120, 230, 120], [220, 120, 255]];
  const colours = colourMap(known.map((_, place) => palette[place % palette.length]));
  labelVolume.setColormapLabel({ ...colours, A: known.map((label) => (label ? 255 : 0)), I: [...known.keys()] });
  return { labelVolume, labelMaps };
}

const vertexOf = (vertices, i) => [vertices[i], vertices[i + 1], vertices[i + 2]];

// The brain, and its outlines before and after, as lines in the planes.
function addSurfaces(nv, { vertices, triangles, displacementAt }) {
  const shifts = new Float32Array(vertices.length);
  for (let i = 0; i < vertices.length; i += 3) shifts.set(displacementAt(vertexOf(vertices, i)), i);
  const add = (name, colour, share) => {
    const moved = vertices.map((x, i) => (i % 3 < 2 ? -1 : 1) * (x + share * shifts[i]));
    const mesh = new niivue.NVMesh(moved, triangles, name, new Uint8Array([...colour, 255]), 1, true, nv.gl);
    nv.addMesh(mesh);
    return mesh;
  };
  const surface = add("brain", flesh, 0);
  for (const outline of [add("before", blue, 0), add("after", orange, 1)]) nv.setMeshShader(outline.id, "Crosscut");
  return { surface, shifts };
}

// Measured points, 250 at most: a ball before, one after, and a line between them. Nothing where there are none, as
// NiiVue loses its places with an empty mesh.
function addPoints(nv, measured) {
  element("points_shown").disabled = measured.length === 0;
  if (measured.length === 0) return null;
  const drawn = measured.filter((_, i) => i % Math.ceil(measured.length / 250) === 0);
  const ends = drawn.flatMap(({ at, shift }) => [at, at.map((x, axis) => x + shift[axis])]);
  nv.addColormap("points", colourMap([blue, orange]));
  const points = nv.loadConnectomeAsMesh({
    name: "points", showLegend: false, nodeColormap: "points", nodeMinColor: 0, nodeMaxColor: 1, nodeScale: 1.2,
    edgeColormap: "points", edgeMin: -1, edgeMax: 1, edgeScale: 0.3,
    nodes: ends.map(flipped).map(([x, y, z], i) => ({ name: "", x, y, z, colorValue: i % 2, sizeValue: 1 })),
    edges: drawn.map((_, i) => ({ first: 2 * i, second: 2 * i + 1, colorValue: 1 })),
  });
  nv.addMesh(points);
  return points;
}

// The opening's middle, seen from outside.
function look(nv, { focus, inward }) {
  const [x, y, z] = flipped(inward).map((part) => -part); // from the brain to the eye
  nv.scene.crosshairPos = nv.mm2frac(flipped(focus));
  nv.scene.volScaleMultiplier = 1.3;
  nv.setRenderAzimuthElevation((Math.atan2(-x, -y) * 180) / Math.PI, (Math.asin(z) * 180) / Math.PI);
}

// --- What the controls do ---

const shareAfter = () => element("slider").value / 100;
const isAfter = () => shareAfter() >= 0.5;

function drawImages({ image, change }, { imageVolume, labelVolume, labelMaps }) {
  const after = shareAfter();
  for (let i = 0; i < image.length; ++i) {
    const warped = (image[i] + change[i]) & 255; // as viewer_data.cpp took the difference
    imageVolume.img[i] = image[i] + after * (warped - image[i]);
  }
  if (!labelVolume) return;
  labelVolume.img.set(labelMaps[isAfter() ? 1 : 0]);
  labelVolume.opacity = element("labels_shown").checked ? 0.5 : 0;
}

function drawBar({ values, colours, low, high, unit }) {
  element("bar").style.background =
    values ? `linear-gradient(to right, ${colours.map((c) => `rgb(${c})`).join()})` : "none";
  element("low").textContent = values ? Number(low.toPrecision(3)) : "";
  element("high").textContent = values ? `${Number(high.toPrecision(3))} ${unit}` : "";
}

function drawOverlay(run, kind, { overlay, opacity }) {
  opacity.img.fill(0);
  if (!kind.values) return;
  const sources = isAfter() && sourcesOf(run);
  for (let v = 0; v < run.brain.length; ++v) {
    const inside = sources ? valueAt(run.fields, run.brain, sources[v]) > 0.5 : run.brain[v];
    overlay.img[v] = sources ? valueAt(run.fields, kind.values, sources[v]) : kind.values[v];
    opacity.img[v] = inside ? 0.7 * strength(kind, overlay.img[v]) : 0;
  }
  Object.assign(overlay, { colormap: kind.name, cal_min: kind.low, cal_max: kind.high });
}

function drawSurface({ vertices, fields }, kind, { nv, surface, shifts }) {
  const after = shareAfter();
  surface.rgba255 = new Uint8Array((vertices.length / 3) * 4).fill(255);
  for (let i = 0; i < vertices.length; i += 3) {
    const vertex = vertexOf(vertices, i);
    const value = kind.values && valueAt(fields, kind.values, vertex);
    const colour = kind.values ? mixed(flesh, colourOf(kind, value), strength(kind, value)) : flesh;
    surface.rgba255.set(colour, (i / 3) * 4);
    surface.pts.set(flipped(vertex.map((x, axis) => x + after * shifts[i + axis])), i);
  }
  surface.updateMesh(nv.gl);
}

// --- Begin ---

async function show(run) {
  const nv = await newView();
  const imageVolume =
    await addVolume(nv, "image", run.images, run.image, { colormap: "gray", cal_min: 0, cal_max: 252 });
  const shown = { nv, imageVolume, ...await addOverlay(nv, run), ...await addLabels(nv, run), ...addSurfaces(nv, run) };
  const points = addPoints(nv, run.measured);
  for (const [i, kind] of run.kinds.entries()) element("colours").add(new Option(kind.name, i, i === 1, i === 1));

  let clicked = run.focus;
  const describe = (place) => {
    clicked = place;
    element("readout").textContent = wordsOf(run, place, isAfter());
  };
  const draw = () => {
    const kind = run.kinds[element("colours").value];
    drawImages(run, shown);
    drawBar(kind);
    drawOverlay(run, kind, shown);
    drawSurface(run, kind, shown);
    if (points) points.visible = element("points_shown").checked;
    nv.updateGLVolume();
    describe(clicked);
    document.body.dataset.view = `drawn at ${element("slider").value}`; // viewer_test.py waits for it
  };

  let asked = null; // many inputs between two frames are drawn once
  const drawLater = () => {
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(draw);
  };
  for (const control of ["slider", "colours", "labels_shown", "points_shown"]) {
    element(control).addEventListener("input", drawLater);
  }
  nv.onLocationChange = ({ mm: place }) => describe(flipped(place));
  // NiiVue picks a place of the surface on a double click, and tells nobody.
  element("canvas").addEventListener("dblclick", () => describe(flipped(nv.frac2mm(nv.scene.crosshairPos))));
  look(nv, run);
  draw();
}

async function load(kind, id) {
  const library = document.createElement(kind);
  library.textContent = await unpackedText(id);
  document.head.append(library);
}

async function begin(says) {
  element("licences").textContent = await unpackedText("copyright");
  const facts = JSON.parse(await unpackedText("facts"));
  await load("style", "uplot_style");
  await load("script", "uplot");
  if (facts.history) drawCurves(facts.history, facts.options.solve ?? {});
  if (!says) return; // there was nothing to turn
  if (!document.createElement("canvas").getContext("webgl2")) {
    says.textContent = "This browser has no WebGL2, or it is switched off, so nothing can be turned here. The "
      + "pictures below show the same run. Another browser, or hardware acceleration switched on in this one's "
      + "settings, brings the view.";
    return;
  }
  element("controls").hidden = element("frame").hidden = false;
  await load("script", "niivue");
  await show(await unpackedRun(facts));
  says.textContent = "Click or drag in a plane, or double-click on the brain, to read what happens there; drag the "
    + "brain to turn it; scroll to zoom it or to go through the slices. The slider takes image, labels and surface "
    + "from before the operation to after it; in between the image is only faded. From its middle on, colours and "
    + "words are those of the tissue as it lies after. Lines: the brain's surface before (blue) and after (orange).";
}

begin(element("says")).catch((error) => {
  console.error(error);
  if (!element("says")) return;
  element("controls").hidden = element("frame").hidden = true;
  element("says").textContent = `The view cannot be drawn (${error.message}). The pictures below show the same run.`;
});
