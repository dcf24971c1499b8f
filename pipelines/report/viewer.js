// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the report that moves: the solver's curves (uPlot), and three planes with the brain in 3-D (NiiVue).
// page.cpp puts it at the end of the page, with what viewer_data.cpp packed. Places and displacements are in LPS, mm;
// NiiVue's are in RAS, and flipped() leads from either to the other.
(async () => {
  "use strict";
  const element = (id) => document.getElementById(id);
  const flipped = ([x, y, z]) => [-x, -y, z];
  const length = (v) => Math.hypot(...v);

  async function unpacked(id) {
    const text = element(id).textContent;
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const format = text.startsWith("H4sI") ? "gzip" : "deflate"; // what gzip's first bytes look like
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream(format))).arrayBuffer();
  }
  const unpackedText = async (id) => new TextDecoder().decode(await unpacked(id));

  async function loadLibrary(id) {
    const script = document.createElement("script");
    script.textContent = await unpackedText(id);
    document.head.append(script);
  }

  // Columns by their names.
  function table(csv) {
    const rows = csv.trim().split("\n").filter((line) => !line.startsWith("#")).map((line) => line.split(","));
    return Object.fromEntries(rows[0].map((name, i) => [name, rows.slice(1).map((row) => Number(row[i]))]));
  }

  // --- Curves ---

  function drawCurves(history, options) {
    const columns = table(history);
    const inTime = options.dynamics === "transient";
    const colours = ["#145aaa", "#d25a14", "#288c3c", "#96288c"];
    const draw = (title, xName, yName, series, logarithmic) => {
      const x = columns[xName === "step" ? "step" : "time"];
      const shown = (y) => (Number.isFinite(y) && (!logarithmic || y > 0) ? y : null);
      const lines = series.filter(([, values]) => values && values.some((y) => shown(y) > 0));
      if (x.length < 2 || lines.length === 0) return;
      const loading = columns.time.findIndex((time) => time >= 1);
      const shadeLoading = (plot) => {
        if (xName !== "step" || loading < 1) return;
        const { left, top, height } = plot.bbox;
        plot.ctx.fillStyle = "#eef2f7";
        plot.ctx.fillRect(left, top, plot.valToPos(x[loading], "x", true) - left, height);
      };
      new uPlot({
        title, width: 560, height: 340, hooks: { drawClear: [shadeLoading] },
        scales: { x: { time: false }, y: logarithmic ? { distr: 3 } : {} },
        axes: [{ label: xName }, { label: yName, size: 70 }],
        series: [{ label: xName },
          ...lines.map(([label, , dash], i) =>
            ({ label, stroke: colours[i], width: 2, dash, points: { show: !dash } }))],
      }, [x, ...lines.map(([, values]) => values.map(shown))], element("curves"));
    };
    const tolerance = columns.step.map(() => Number(options.tolerance));
    draw(columns.time[0] < 1 ? "Convergence (shaded: loading)" : "Convergence", "step", "",
      [["bound of the remaining error, mm", columns.error_bound_mm], ["residual / force", columns.residual],
        ["tolerance, mm", tolerance, [6, 4]]], true);
    draw("Energies", inTime ? "time, s" : "step", "mJ",
      [["external work", columns.external_work_mJ], ["strain energy", columns.strain_energy_mJ],
        ["kinetic energy", columns.kinetic_energy_mJ], ["dissipated", columns.dissipated_energy_mJ]], false);
  }

  // --- Fields on grids ---

  const transformed = (m, [x, y, z]) =>
    [0, 4, 8].map((row) => m[row] * x + m[row + 1] * y + m[row + 2] * z + m[row + 3]);

  // Linear between the voxels; beyond the grid as at its border. Called millions of times: no array is made here.
  function valueAt(grid, values, place, component = 0) {
    const [nx, ny, nz] = grid.size;
    const m = grid.to_index, [px, py, pz] = place;
    const x = Math.max(0, Math.min(nx - 1, m[0] * px + m[1] * py + m[2] * pz + m[3]));
    const y = Math.max(0, Math.min(ny - 1, m[4] * px + m[5] * py + m[6] * pz + m[7]));
    const z = Math.max(0, Math.min(nz - 1, m[8] * px + m[9] * py + m[10] * pz + m[11]));
    const i = Math.min(nx - 2, Math.floor(x)), j = Math.min(ny - 2, Math.floor(y)), k = Math.min(nz - 2, Math.floor(z));
    const a = x - i, b = y - j, c = z - k;
    const first = i + nx * (j + ny * (k + nz * component));
    const along = (from) => values[from] * (1 - a) + values[from + 1] * a;
    const layer = (from) => along(from) * (1 - b) + along(from + nx) * b;
    return layer(first) * (1 - c) + layer(first + nx * ny) * c;
  }

  const nearest = (grid, values, place) => {
    const [i, j, k] = transformed(grid.to_index, place).map(Math.round);
    return values[i + grid.size[0] * (j + grid.size[1] * k)];
  };

  // --- The view ---

  // Evenly spaced colours, as NiiVue takes them.
  const colourMap = (colours) => ({
    R: colours.map((c) => c[0]), G: colours.map((c) => c[1]), B: colours.map((c) => c[2]), A: colours.map(() => 255),
    I: colours.map((_, i) => Math.round((255 * i) / (colours.length - 1))),
  });

  const mixed = (a, b, share) => a.map((from, i) => from + (b[i] - from) * share);

  function colourOf({ colours, low, high }, value) {
    const place = Math.max(0, Math.min(1, (value - low) / (high - low))) * (colours.length - 1);
    const below = Math.min(Math.floor(place), colours.length - 2);
    return mixed(colours[below], colours[below + 1], place - below);
  }

  async function show(facts) {
    const { images, fields } = facts;
    const numbers = async (name, Type) => (element(name) ? new Type(await unpacked(name)) : null);
    const t1 = await numbers("image", Uint8Array);
    const change = await numbers("image_change", Uint8Array);
    const brain = await numbers("brain", Uint8Array);
    const steps = await numbers("displacement", Int16Array);
    const voxels = brain.length;
    const displacementAt = (place) =>
      [0, 1, 2].map((axis) => facts.steps.displacement * valueAt(fields, steps, place, axis));
    // Where the tissue was that now lies at a place: x + u(x) = place.
    const cameFrom = (place) => {
      let x = place;
      for (let i = 0; i < 20; ++i) {
        const u = displacementAt(x);
        const next = place.map((y, axis) => y - u[axis]);
        const moved = Math.max(...next.map((y, axis) => Math.abs(y - x[axis])));
        x = next;
        if (moved < 0.01) break;
      }
      return x;
    };

    const scaled = async (name) =>
      Float32Array.from(await numbers(name, Int16Array), (value) => value * facts.steps[name]);
    const quantile = (values, share) => {
      const inside = values.filter((_, voxel) => brain[voxel]).sort();
      return inside[Math.floor(share * (inside.length - 1))];
    };
    const rounded = (value) => Number(value.toPrecision(1)) || 1;
    // What may be shown as colours: values on the grid of the fields, and the one where nothing happens.
    const kinds = [{ name: "none" }, {
      name: "displacement", unit: "mm", low: 0, high: facts.largest, neutral: 0, colours: facts.sequential,
      values: Float32Array.from(brain, (_, voxel) =>
        facts.steps.displacement * Math.hypot(steps[voxel], steps[voxel + voxels], steps[voxel + 2 * voxels])),
    }];
    if (facts.steps.error) {
      const values = await scaled("error");
      const high = rounded(quantile(values, 0.99));
      kinds.push({ ...kinds[1], name: "estimated error", high, values });
    }
    if (facts.steps.ratio) {
      const values = await scaled("ratio");
      const reach = Math.max(0.02, rounded(quantile(values.map((value) => Math.abs(value - 1)), 0.99)));
      const [low, high] = [1 - reach, 1 + reach];
      kinds.push({ name: "volume ratio", unit: "", low, high, neutral: 1, colours: facts.diverging, values });
    }

    const nv = new niivue.Niivue({
      backColor: [0, 0, 0, 1], fontColor: [0.9, 0.9, 0.9, 1], crosshairColor: [0.3, 1, 0.4, 1], crosshairWidth: 0.4,
      crosshairGap: 8, show3Dcrosshair: true,
      isRadiologicalConvention: true, sagittalNoseLeft: true, isSliceMM: true, multiplanarForceRender: true,
      multiplanarShowRender: niivue.SHOW_RENDER.ALWAYS, multiplanarLayout: niivue.MULTIPLANAR_TYPE.GRID,
      meshThicknessOn2D: 0.7, dragAndDropEnabled: false, logLevel: "error",
    });
    await nv.attachToCanvas(element("canvas"));
    nv.drawImage3D = () => {}; // in 3-D the image's block would hide the surface

    const addVolume = async (name, grid, type, values, more) => {
      const m = [...grid.to_world.map((value, i) => (i < 8 ? -value : value)), 0, 0, 0, 1];
      const spacing = [0, 1, 2].map((axis) => Math.hypot(m[axis], m[axis + 4], m[axis + 8]));
      const bytes = niivue.NVImage.createNiftiArray(grid.size, spacing, m, type, values);
      const volume = await niivue.NVImage.loadFromFile({ file: new File([bytes], `${name}.nii`), name, ...more });
      nv.addVolume(volume);
      return volume;
    };
    const uint8 = 2, float32 = 16;
    const image = await addVolume("image", images, uint8, t1, { colormap: "gray", cal_min: 0, cal_max: 252 });
    const overlay = await addVolume("overlay", fields, float32, new Float32Array(voxels), {});
    const opacity = await addVolume("opacity", fields, float32, new Float32Array(voxels), { opacity: 0 });
    Object.assign(opacity, { cal_min: 0, cal_max: 1 });
    Object.assign(overlay, { modulationImage: nv.volumes.indexOf(opacity), modulateAlpha: 1 });
    for (const kind of kinds.slice(1)) nv.addColormap(kind.name, colourMap(kind.colours));

    // NiiVue's palettes have 256 places: a label is shown by its place among those that there are.
    const labels = [await numbers("labels", Uint16Array), await numbers("labels_after", Uint16Array)];
    const known = labels[0] ? [...new Set(labels[0])].sort((a, b) => a - b) : [];
    const places = new Map(known.map((label, place) => [label, place]));
    const labelled = labels.map((map) => map && Uint8Array.from(map, (label) => places.get(label) || 0));
    const labelName = (label) => {
      const name = facts.options.tissues?.[label]?.name;
      return `label ${label}${name ? ` (${name})` : ""}`;
    };
    element("labels_shown").disabled = known.length < 2;
    let labelVolume = null;
    if (known.length > 1) {
      const palette = [[255, 150, 60], [255, 80, 80], [80, 200, 255], [255, 210, 60], [120, 230, 120], [220, 120, 255]];
      const colours = known.map((_, place) => palette[place % palette.length]);
      labelVolume = await addVolume("labels", images, uint8, labelled[0], { opacity: 0 });
      const opacities = known.map((label) => (label ? 255 : 0));
      labelVolume.setColormapLabel({ ...colourMap(colours), A: opacities, I: [...known.keys()] });
    }

    const vertices = await numbers("vertices", Float32Array);
    const shifts = new Float32Array(vertices.length);
    const vertex = (i) => [vertices[i], vertices[i + 1], vertices[i + 2]];
    for (let i = 0; i < vertices.length; i += 3) shifts.set(displacementAt(vertex(i)), i);
    const triangles = new Uint32Array(await unpacked("triangles"));
    const addSurface = (name, colour, share) => {
      const moved = vertices.map((x, i) => (i % 3 < 2 ? -1 : 1) * (x + share * shifts[i]));
      const mesh = new niivue.NVMesh(moved, triangles, name, new Uint8Array([...colour, 255]), 1, true, nv.gl);
      nv.addMesh(mesh);
      return mesh;
    };
    const flesh = [220, 200, 190], blue = [90, 200, 250], orange = [255, 150, 60];
    const surface = addSurface("brain", flesh, 0);
    for (const outline of [addSurface("before", blue, 0), addSurface("after", orange, 1)]) {
      nv.setMeshShader(outline.id, "Crosscut"); // its cut by the planes, as a line
    }

    const load = facts.load ? table(facts.load) : { x: [] };
    const measured = load.x.map((x, i) => ({
      at: [x, load.y[i], load.z[i]], shift: [load.ux[i], load.uy[i], load.uz[i]],
      deviation: load.sigma?.[i] ?? (load.sigma_x && length([load.sigma_x[i], load.sigma_y[i], load.sigma_z[i]])),
    }));
    const drawn = measured.filter((_, i) => i % Math.ceil(measured.length / 250) === 0);
    nv.addColormap("points", colourMap([blue, orange]));
    const ends = drawn.flatMap(({ at, shift }) => [at, at.map((x, axis) => x + shift[axis])]);
    const points = nv.loadConnectomeAsMesh({
      name: "points", showLegend: false, nodeColormap: "points", nodeMinColor: 0, nodeMaxColor: 1, nodeScale: 1.2,
      edgeColormap: "points", edgeMin: -1, edgeMax: 1, edgeScale: 0.3,
      nodes: ends.map(flipped).map(([x, y, z], i) => ({ name: "", x, y, z, colorValue: i % 2, sizeValue: 1 })),
      edges: drawn.map((_, i) => ({ first: 2 * i, second: 2 * i + 1, colorValue: 1 })),
    });
    nv.addMesh(points);
    element("points_shown").disabled = measured.length === 0;
    const asked = facts.uncertainty ? table(facts.uncertainty) : { x: [] };
    const deviations = asked.x.map((x, i) => ({
      at: [x, asked.y[i], asked.z[i]], deviation: Math.sqrt(asked.xx[i] + asked.yy[i] + asked.zz[i]),
    }));

    // --- What the controls do ---

    const slider = element("slider"), colours = element("colours");
    const shareAfter = () => slider.value / 100;
    const isAfter = () => slider.value >= 50;
    let sources = null; // where each voxel's tissue was
    const sourceOf = (voxel) => {
      sources ??= Array.from(brain, (_, v) => {
        const [nx, ny] = fields.size;
        return cameFrom(transformed(fields.to_world, [v % nx, Math.floor(v / nx) % ny, Math.floor(v / (nx * ny))]));
      });
      return sources[voxel];
    };

    // 0 where nothing happens, so that the image or the bare surface is seen.
    const strength = (kind, value) => Math.min(1, 3 * Math.abs(value - kind.neutral) / (kind.high - kind.neutral));

    function drawImage() {
      const after = shareAfter();
      for (let i = 0; i < t1.length; ++i) {
        const warped = (t1[i] + change[i]) & 255; // as viewer_data.cpp took the difference
        image.img[i] = t1[i] + after * (warped - t1[i]);
      }
      if (labelVolume) labelVolume.img.set(labelled[isAfter() ? 1 : 0]);
    }

    function drawColours() {
      const kind = kinds[colours.value];
      element("bar").style.background = kind.values
        ? `linear-gradient(to right, ${kind.colours.map((c) => `rgb(${c})`).join()})` : "none";
      element("low").textContent = kind.values ? Number(kind.low.toPrecision(3)) : "";
      element("high").textContent = kind.values ? `${Number(kind.high.toPrecision(3))} ${kind.unit}` : "";
      opacity.img.fill(0);
      if (!kind.values) return;
      const moved = isAfter();
      for (let v = 0; v < voxels; ++v) {
        const place = moved && sourceOf(v);
        const inside = moved ? valueAt(fields, brain, place) > 0.5 : brain[v];
        overlay.img[v] = moved ? valueAt(fields, kind.values, place) : kind.values[v];
        opacity.img[v] = inside ? 0.7 * strength(kind, overlay.img[v]) : 0;
      }
      overlay.colormap = kind.name;
      overlay.cal_min = kind.low;
      overlay.cal_max = kind.high;
    }

    function drawSurface() {
      const kind = kinds[colours.value];
      const after = shareAfter();
      const rgba = new Uint8Array((vertices.length / 3) * 4).fill(255);
      for (let i = 0; i < vertices.length; i += 3) {
        const value = kind.values && valueAt(fields, kind.values, vertex(i));
        rgba.set(kind.values ? mixed(flesh, colourOf(kind, value), strength(kind, value)) : flesh, (i / 3) * 4);
        surface.pts.set(flipped(vertex(i).map((x, axis) => x + after * shifts[i + axis])), i);
      }
      surface.rgba255 = rgba;
      surface.updateMesh(nv.gl);
    }

    function draw() {
      drawImage();
      drawColours();
      drawSurface();
      if (labelVolume) labelVolume.opacity = element("labels_shown").checked ? 0.5 : 0;
      points.visible = element("points_shown").checked;
      nv.updateGLVolume();
      describe(clicked);
      document.body.dataset.view = `drawn at ${slider.value}`;
    }

    // --- What a click says ---

    let clicked = facts.focus;
    const mm = (value) => `${value.toFixed(Math.abs(value) < 1 ? 2 : 1)} mm`;
    const directions = (u) => [["to the left", "to the right"], ["backwards", "forwards"], ["up", "down"]]
      .map(([plus, minus], axis) => `${mm(Math.abs(u[axis]))} ${u[axis] < 0 ? minus : plus}`).join(", ");
    function describe(place) {
      clicked = place;
      const source = isAfter() ? cameFrom(place) : place;
      const u = displacementAt(source);
      const parts = [`At ${place.map((x) => x.toFixed(1)).join(", ")} (LPS, mm), ${isAfter() ? "after" : "before"}:`];
      if (valueAt(fields, brain, source) > 0) { // its surface, too
        const tissue = isAfter() ? "the tissue that lies here came" : "the tissue here moves";
        parts.push(`${tissue} ${mm(length(u))}: ${directions(u)}.`);
        for (const kind of kinds.slice(2)) {
          const value = valueAt(fields, kind.values, source);
          parts.push(kind.unit ? `Estimated error of the computation: ${mm(value)}.`
            : `Its volume becomes ${value.toFixed(3)} of what it was.`);
        }
      } else {
        parts.push("outside the brain, where nothing is predicted.");
      }
      const label = labels[0] && nearest(images, labels[0], source);
      if (label) parts.push(`${labelName(label)}.`);
      const nearestOf = (all) => all
        .map((point) => ({ ...point, far: length(point.at.map((x, axis) => x - source[axis])) }))
        .filter(({ far }) => far < 20).sort((a, b) => a.far - b.far)[0];
      const landmark = nearestOf(deviations);
      if (landmark) {
        parts.push(`Standard deviation, at a landmark ${mm(landmark.far)} away: ${mm(landmark.deviation)}.`);
      }
      const near = nearestOf(measured);
      if (near) {
        const computed = displacementAt(near.at);
        parts.push(`Nearest measured point, ${mm(near.far)} away: measured ${mm(length(near.shift))}`,
          near.deviation ? `(standard deviation ${mm(near.deviation)}),` : "and",
          `computed ${mm(length(computed))}; they differ by ${mm(length(computed.map((x, i) => x - near.shift[i])))}.`);
      }
      element("readout").textContent = parts.join(" ");
    }

    for (const [i, kind] of kinds.entries()) colours.add(new Option(kind.name, i, i === 1, i === 1));
    let waiting = false;
    const later = () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        draw();
      });
    };
    for (const control of ["slider", "colours", "labels_shown", "points_shown"]) {
      element(control).addEventListener("input", later);
    }
    nv.onLocationChange = ({ mm: place }) => describe(flipped(place));
    // NiiVue picks a place of the surface on a double click, and tells nobody.
    element("canvas").addEventListener("dblclick", () =>
      describe(flipped([...nv.frac2mm(nv.scene.crosshairPos, 0, true)].slice(0, 3))));
    nv.scene.crosshairPos = nv.mm2frac(flipped(facts.focus));
    const [x, y, z] = flipped(facts.inward).map((part) => -part); // from the brain to the eye
    nv.scene.volScaleMultiplier = 1.3;
    nv.setRenderAzimuthElevation((Math.atan2(-x, -y) * 180) / Math.PI, (Math.asin(z) * 180) / Math.PI);
    draw();
  }

  // --- Begin ---

  const says = element("says");
  try {
    element("licences").textContent = await unpackedText("copyright");
    const facts = JSON.parse(await unpackedText("facts"));
    const style = document.createElement("style");
    style.textContent = await unpackedText("uplot_style");
    document.head.append(style);
    await loadLibrary("uplot");
    if (facts.history) drawCurves(facts.history, facts.options.solve ?? {});
    if (!says) return;
    if (!document.createElement("canvas").getContext("webgl2")) {
      says.textContent = "This browser has no WebGL2, or it is switched off, so nothing can be turned here. The "
        + "pictures below show the same run. Another browser, or hardware acceleration switched on in this one's "
        + "settings, brings the view.";
      return;
    }
    element("controls").hidden = element("frame").hidden = false;
    await loadLibrary("niivue");
    await show(facts);
    says.textContent = "Click or drag in a plane, or double-click on the brain, to read what happens there; drag the "
      + "brain to turn it; scroll to zoom it or to go through the slices. The slider takes image, labels and surface "
      + "from before the operation to after it; in between the image is only faded. From its middle on, colours and "
      + "words are those of the tissue as it lies after. Lines: the brain's surface before (blue) and after (orange).";
  } catch (error) {
    console.error(error);
    if (says) says.textContent = `The view cannot be drawn (${error.message}). The pictures below show the same run.`;
  }
})();
