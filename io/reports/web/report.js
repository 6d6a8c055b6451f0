"use strict";
// The report's page: reads the data that coseg put into it; draws with three.js and Chart.js.
(function () {
  const report = data.report;
  const shapes = report.meshes.map((mesh, number) => Object.assign({ number }, mesh, data.shapes[number]));
  const partCount = report.options.parts;
  const colorOf = (part) => data.colors[part % data.colors.length];
  const percent = (share) => (100 * share).toFixed(1) + " %";
  const significant = (value) => (value === 0 ? "0" : Math.abs(value) < 1e-3 ? Number(value).toExponential(1) : Number(value).toPrecision(3));

  function fillHeading() {
    element("subtitle").textContent = shapes.length + (shapes.length === 1 ? " shape, " : " shapes, ") + partCount +
      (partCount === 1 ? " part, " : " parts, ") + report.ranks + (report.ranks === 1 ? " rank" : " ranks") +
      ", coseg " + report.versions.coseg;
    const counted = report.partition.part_count;
    if (counted) element("counted").textContent = "Number of parts found: " + counted.sentence + ".";
    const solved = report.optimisation;
    const warnings = shapes.reduce((sum, shape) => sum + shape.warnings.length, 0);
    const facts = [["seconds", report.seconds.toFixed(1)], ["faces", shapes.reduce((sum, s) => sum + s.faces, 0).toLocaleString("en")],
      ["patches", solved.patches.toLocaleString("en")], ["relative gap", significant(solved.relative_gap)],
      ["pairs", solved.nonzero_groups.toLocaleString("en")], ["warnings", warnings], ["set aside", report.set_aside.length]];
    if (data.accuracy !== null) facts.unshift(["accuracy", percent(data.accuracy)]);
    for (const [name, value] of facts) {
      const card = make("div", element("facts"), undefined, "card");
      make("b", card, value);
      make("span", card, name, "faint");
    }
  }

  // ---- the shapes' meshes, decoded when they are first looked at

  // Of a very large collection not every shape is in the page.
  const solids = shapes.filter((shape) => element("mesh" + shape.number));
  const isSolid = new Set(solids.map((shape) => shape.number));

  const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;

  function decode(number) {
    const buffer = bytesOf(element("mesh" + number).textContent);
    const [vertices, faces] = new Uint32Array(buffer, 0, 2);
    const isWide = vertices > 65535;
    const places = new Uint16Array(buffer, 8, 3 * vertices);
    let at = 8 + 6 * vertices;
    at += at % 4;
    const corners = isWide ? new Uint32Array(buffer, at, 3 * faces) : new Uint16Array(buffer, at, 3 * faces);
    at += (isWide ? 12 : 6) * faces;
    const labels = new Uint16Array(buffer, at, faces);
    const positions = new Float32Array(3 * vertices);
    for (let i = 0; i < positions.length; ++i) positions[i] = places[i] / 32767.5 - 1;
    return { positions, corners, labels };
  }

  // Normals are smooth where triangles about a vertex turn by less than 40 degrees, as in the contact sheet.
  function cornerNormals(mesh) {
    const { positions: p, corners } = mesh;
    const faceCount = corners.length / 3;
    const flat = new Float32Array(corners.length);
    const around = new Map();
    for (let f = 0; f < faceCount; ++f) {
      const [a, b, c] = [3 * corners[3 * f], 3 * corners[3 * f + 1], 3 * corners[3 * f + 2]];
      const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
      const v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
      flat.set([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], 3 * f);
      for (let k = 0; k < 3; ++k) {
        const vertex = corners[3 * f + k];
        if (around.has(vertex)) around.get(vertex).push(f);
        else around.set(vertex, [f]);
      }
    }
    const length = (f) => Math.hypot(flat[3 * f], flat[3 * f + 1], flat[3 * f + 2]) || 1;
    const normals = new Float32Array(3 * corners.length);
    for (let f = 0; f < faceCount; ++f) {
      for (let k = 0; k < 3; ++k) {
        const sum = [0, 0, 0];
        for (const g of around.get(corners[3 * f + k])) {
          const dot = flat[3 * f] * flat[3 * g] + flat[3 * f + 1] * flat[3 * g + 1] + flat[3 * f + 2] * flat[3 * g + 2];
          if (dot < 0.766 * length(f) * length(g)) continue;
          for (let i = 0; i < 3; ++i) sum[i] += flat[3 * g + i];
        }
        const size = Math.hypot(sum[0], sum[1], sum[2]) || 1;
        for (let i = 0; i < 3; ++i) normals[9 * f + 3 * k + i] = sum[i] / size;
      }
    }
    return normals;
  }

  const wrongBit = 0x8000;

  // One three.js mesh a part, so that a part can be hidden.
  function meshesByPart(number, showErrors) {
    const mesh = decode(number);
    const normals = cornerNormals(mesh);
    const facesOf = new Map();
    mesh.labels.forEach((label, f) => {
      const part = label & ~wrongBit;
      if (!facesOf.has(part)) facesOf.set(part, []);
      facesOf.get(part).push(f);
    });
    const group = new THREE.Group();
    for (const [part, faces] of facesOf) {
      const positions = new Float32Array(9 * faces.length);
      const partNormals = new Float32Array(9 * faces.length);
      const colors = new Float32Array(9 * faces.length);
      const plain = new THREE.Color(colorOf(part));
      const right = new THREE.Color("#c4cbd2"), wrong = new THREE.Color("#d82c2c");
      faces.forEach((f, at) => {
        const color = !showErrors ? plain : (mesh.labels[f] & wrongBit ? wrong : right);
        for (let k = 0; k < 3; ++k) {
          const vertex = 3 * mesh.corners[3 * f + k];
          positions.set(mesh.positions.subarray(vertex, vertex + 3), 9 * at + 3 * k);
          colors.set([color.r, color.g, color.b], 9 * at + 3 * k);
        }
        partNormals.set(normals.subarray(9 * f, 9 * f + 9), 9 * at);
      });
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
      geometry.setAttribute("normal", new THREE.BufferAttribute(partNormals, 3));
      geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
      const material = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors, side: THREE.DoubleSide });
      const drawn = new THREE.Mesh(geometry, material);
      drawn.userData.part = part;
      group.add(drawn);
    }
    return group;
  }

  // ---- the viewers

  const hidden = new Set();
  const viewers = [];
  let showErrors = false;

  class Viewer {
    constructor(parent) {
      this.select = make("select", parent);
      this.select.setAttribute("aria-label", "shape");
      for (const shape of solids) make("option", this.select, shape.name).value = shape.number;
      this.select.addEventListener("change", () => this.show(Number(this.select.value)));
      this.canvas = make("canvas", parent);
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
      this.renderer.setClearColor(0xf7f7f5);
      this.renderer.setPixelRatio(window.devicePixelRatio || 1);
      this.scene = new THREE.Scene();
      this.camera = new THREE.PerspectiveCamera(28, 1, 0.05, 50);
      const [up, towards] = [new THREE.Vector3(...data.up), new THREE.Vector3(...data.towards)];
      this.camera.up.copy(up);
      this.camera.position.copy(towards).multiplyScalar(4.6);
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.addEventListener("change", () => this.turned());
      this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a90, 0.62));
      this.scene.children[0].position.copy(up);
      const lamp = new THREE.DirectionalLight(0xffffff, 0.5);
      lamp.position.set(-0.6, 0.8, 0.9);
      this.camera.add(lamp);
      this.scene.add(this.camera);
      this.group = null;
      this.number = -1;
    }
    show(number) {
      if (this.group) {
        this.scene.remove(this.group);
        for (const mesh of this.group.children) { mesh.geometry.dispose(); mesh.material.dispose(); }
      }
      this.number = number;
      this.select.value = number;
      this.group = meshesByPart(number, showErrors);
      this.scene.add(this.group);
      this.draw();
      markShown();
    }
    turned() {
      for (const other of viewers) {
        if (other === this) continue;
        other.camera.position.copy(this.camera.position);
        other.camera.quaternion.copy(this.camera.quaternion);
        other.controls.target.copy(this.controls.target);
        other.draw();
      }
      this.draw();
    }
    draw() {
      const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
      if (width === 0 || !this.group) return;
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      for (const mesh of this.group.children) mesh.visible = !hidden.has(mesh.userData.part);
      this.renderer.render(this.scene, this.camera);
    }
  }

  function markShown() {
    const shown = new Set(viewers.map((viewer) => viewer.number));
    for (const row of document.querySelectorAll("#shapes tbody tr")) row.classList.toggle("shown", shown.has(Number(row.dataset.number)));
  }

  function toggleButton(parent, text, className, pressed, toggle) {
    const button = make("button", parent, text, className);
    button.setAttribute("aria-pressed", pressed);
    button.addEventListener("click", () => {
      const next = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", next);
      toggle(next);
    });
    return button;
  }

  function fillViewers() {
    try {
      viewers.push(new Viewer(element("viewerA")));
    } catch (error) {
      element("viewerA").textContent = "This browser offers no WebGL, so shapes cannot be turned here.";
      return;
    }
    viewers[0].show(solids[0].number);
    if (solids.length < shapes.length)
      make("div", element("tools").parentElement, solids.length + " of " + shapes.length + " shapes can be turned here.", "faint");
    const redraw = () => viewers.forEach((viewer) => viewer.draw());
    for (let part = 0; part < partCount; ++part) {
      const button = toggleButton(element("parts"), "part " + part, "part", true, (isShown) => {
        isShown ? hidden.delete(part) : hidden.add(part);
        redraw();
      });
      const swatch = make("span", undefined, "", "swatch");
      swatch.style.background = colorOf(part);
      button.prepend(swatch);
    }
    toggleButton(element("tools"), "compare two", "tool", false, (isOn) => {
      element("viewerB").hidden = !isOn;
      if (isOn && viewers.length === 1) viewers.push(new Viewer(element("viewerB")));
      if (isOn && viewers[1].number < 0) viewers[1].show(solids[Math.min(1, solids.length - 1)].number);
      redraw();
      if (isOn) viewers[0].turned();
    }).id = "compare";
    if (data.accuracy !== null) {
      toggleButton(element("tools"), "show errors", "tool", false, (isOn) => {
        showErrors = isOn;
        viewers.forEach((viewer) => viewer.number >= 0 && viewer.show(viewer.number));
      });
    }
    window.addEventListener("resize", redraw);
  }

  // ---- the table

  const columns = [
    { name: "shape", value: (s) => s.name, cell: (s) => s.name },
    { name: "faces", value: (s) => s.faces, cell: (s) => s.faces.toLocaleString("en") },
    { name: "seconds", value: (s) => s.seconds, cell: (s) => s.seconds.toFixed(2) },
    { name: "accuracy", value: (s) => s.accuracy, cell: (s) => (s.accuracy === null ? "" : percent(s.accuracy)) },
    { name: "confidence", value: (s) => s.confidence, cell: (s) => percent(s.confidence) },
    { name: "parts", value: (s) => Math.max(...s.part_area), cell: null },
    { name: "warnings", value: (s) => s.warnings.length, cell: (s) => s.warnings.join("; ") },
  ].filter((column) => column.name !== "accuracy" || data.accuracy !== null)
    .filter((column) => column.name !== "confidence" || shapes.every((s) => typeof s.confidence === "number"));

  function partBar(cell, shape) {
    const bar = make("span", cell, undefined, "bar");
    bar.title = shape.part_area.map((share, part) => "part " + part + ": " + percent(share)).join("\n");
    shape.part_area.forEach((share, part) => {
      const piece = make("span", bar);
      piece.style.cssText = "width:" + 100 * share + "%;background:" + colorOf(part);
    });
  }

  function fillTable() {
    const body = element("shapes").tBodies[0];
    const rows = shapes.map((shape) => {
      const row = make("tr", body);
      row.dataset.number = shape.number;
      for (const column of columns) {
        const cell = make("td", row, column.cell ? column.cell(shape) : "", column.name === "warnings" ? "wide" : "");
        if (!column.cell) partBar(cell, shape);
      }
      row.addEventListener("click", (event) => {
        const second = event.shiftKey && viewers.length > 1 && !element("viewerB").hidden;
        if (viewers.length && isSolid.has(shape.number)) viewers[second ? 1 : 0].show(shape.number);
      });
      return { row, shape };
    });
    const head = element("shapes").tHead.rows[0];
    columns.forEach((column) => {
      const cell = make("th", head, column.name);
      cell.addEventListener("click", () => {
        const ascending = cell.getAttribute("aria-sort") !== "ascending";
        for (const other of head.cells) other.removeAttribute("aria-sort");
        cell.setAttribute("aria-sort", ascending ? "ascending" : "descending");
        const sign = ascending ? 1 : -1;
        rows.sort((a, b) => {
          const [x, y] = [column.value(a.shape), column.value(b.shape)];
          return sign * (typeof x === "string" ? x.localeCompare(y, "en", { numeric: true }) : x - y);
        });
        for (const { row } of rows) body.appendChild(row);
      });
    });
  }

  // ---- the charts

  function chartBox(title) {
    const box = make("div", element("charts"), undefined, "chart");
    make("h3", box, title);
    return make("canvas", make("div", box));
  }
  const plain = { animation: false, maintainAspectRatio: false };
  const titled = (x, y, more) => Object.assign({}, plain, more, {
    scales: { x: Object.assign({ title: { display: !!x, text: x } }, more && more.x), y: Object.assign({ title: { display: !!y, text: y } }, more && more.y) } });
  const unlabelled = { plugins: { legend: { display: false } } };

  function stageChart() {
    new Chart(chartBox("Seconds per stage"), { type: "bar",
      data: { labels: report.stages.map((s) => s.stage), datasets: [
        { label: "wall", data: report.stages.map((s) => s.seconds_wall), backgroundColor: "#9fb6c9" },
        { label: "busiest rank", data: report.stages.map((s) => s.seconds_max), backgroundColor: "#0072b2" }] },
      options: titled("", "seconds") });
  }
  function strengthChart() {
    const strengths = report.features.strengths;
    if (!strengths.length) return;
    const bars = ["all"].concat(strengths[0].within_part.map((_, part) => "part " + part));
    const shades = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#f0e442", "#d55e00"];
    new Chart(chartBox("Strength of the features"), { type: "bar",
      data: { labels: bars, datasets: strengths.map((s, i) => ({ label: s.feature.replace(/_/g, " "),
        data: [s.overall].concat(s.within_part), backgroundColor: shades[i % shades.length] })) },
      options: titled("", "share of the coefficients", { x: { stacked: true }, y: { stacked: true, max: 1 } }) });
  }
  // A row of the history in words, for the tooltips.
  function passNote(history) {
    return { plugins: { tooltip: { mode: "index", intersect: false, callbacks: {
      title: (items) => "pass " + history[items[0].dataIndex].pass,
      footer: (items) => {
        const row = history[items[0].dataIndex];
        return row.iterations.toLocaleString("en") + " iterations, " + row.working_pairs.toLocaleString("en") + " pairs in the working set";
      } } } } };
  }
  const passes = (history) => history.map((row) => row.pass);
  function boundChart() {
    const o = report.optimisation;
    const history = o.history || [];
    if (history.length > 1) {
      const line = (label, key, color, more) => Object.assign({ label, data: history.map((row) => row[key]), borderColor: color,
        backgroundColor: color, pointRadius: history.length > 40 ? 0 : 3, borderWidth: 2 }, more);
      new Chart(chartBox("Objective and its lower bound"), { type: "line",
        data: { labels: passes(history), datasets: [
          line("objective", "objective", "#0072b2", { fill: { target: 1, above: "rgba(0, 114, 178, 0.12)" } }), line("lower bound", "lower_bound", "#009e73")] },
        options: titled("pass over all pairs", "objective", passNote(history)) });
      return;
    }
    new Chart(chartBox("Objective and its bound (gap " + significant(o.relative_gap) + ", " + o.iterations + " iterations)"), { type: "bar",
      data: { labels: ["W = 0", "found", "lower bound"], datasets: [
        { data: [o.objective_at_zero, o.objective, o.lower_bound], backgroundColor: ["#c9c9c4", "#0072b2", "#009e73"] }] },
      options: titled("", "objective", unlabelled) });
  }
  function gapChart() {
    const o = report.optimisation;
    const history = o.history || [];
    if (history.length < 2) return;
    const target = report.options.gap;
    const dash = { label: "asked for", data: history.map(() => target), borderColor: "#d55e00", backgroundColor: "#d55e00", borderDash: [6, 4], pointRadius: 0, borderWidth: 1.5 };
    // A logarithm has no place for a gap that is closed to the last bit.
    const gaps = history.map((row) => (row.relative_gap > 0 ? row.relative_gap : null));
    new Chart(chartBox("Convergence: gap " + significant(o.relative_gap) + ", " + o.iterations.toLocaleString("en") + " iterations"), { type: "line",
      data: { labels: passes(history), datasets: [{ label: "relative gap", data: gaps, borderColor: "#0072b2", backgroundColor: "#0072b2",
        pointRadius: history.length > 40 ? 0 : 3, borderWidth: 2 }].concat(target > 0 ? [dash] : []) },
      options: titled("pass over all pairs", "relative gap", Object.assign({ y: { type: "logarithmic", ticks: { callback: (value) =>
        (Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9 ? value.toExponential(0) : "") } } }, passNote(history))) });
  }
  function startChart() {
    const p = report.partition;
    if (!p.starts.length) return;
    new Chart(chartBox("Scores of the starts (the chosen one dark)"), { type: "bar",
      data: { labels: p.starts.map((s) => significant(s.adjacency) + " / " + s.clusters), datasets: [
        { data: p.starts.map((s) => s.score), backgroundColor: p.starts.map((_, i) => (i === p.chosen_start ? "#d55e00" : "#e9c9a8")) }] },
      options: titled("adjacency weight / clusters", "score", unlabelled) });
  }
  function eigenvalueChart() {
    const values = report.partition.eigenvalues;
    if (!values.length) return;
    new Chart(chartBox("Eigenvalues of the chosen start"), { type: "line",
      data: { labels: values.map((_, i) => i + 1), datasets: [{ data: values, borderColor: "#0072b2", backgroundColor: "#0072b2" }] },
      options: titled("number", "", unlabelled) });
  }
  function affinityPicture() {
    const affinity = report.partition.affinity;
    if (!affinity || !affinity.rows.length) return;
    const box = make("div", element("charts"), undefined, "chart");
    make("h3", box, "Affinity of the patches, sorted by part");
    const canvas = make("canvas", make("div", box));
    canvas.id = "affinity";
    const size = affinity.rows.length;
    canvas.width = canvas.height = size;
    const context = canvas.getContext("2d");
    const image = context.createImageData(size, size);
    affinity.rows.forEach((row, y) => [...row].forEach((digit, x) => {
      const level = parseInt(digit, 36) / 35;
      const shade = [247 - 247 * level, 247 - 133 * level, 245 - 67 * level];
      image.data.set([...shade, 255], 4 * (y * size + x));
    }));
    context.putImageData(image, 0, 0);
    context.strokeStyle = "#d55e00";
    context.lineWidth = 0.5;
    for (const end of affinity.part_ends.slice(0, -1)) {
      context.strokeRect(end, -1, 0, size + 2);
      context.strokeRect(-1, end, size + 2, 0);
    }
  }

  fillHeading();
  fillTable();
  fillViewers();
  [stageChart, strengthChart, gapChart, boundChart, startChart, eigenvalueChart, affinityPicture].forEach((draw) => draw());
  element("options").textContent = JSON.stringify(report.options, null, 2);
  window.cosegReport = { viewers, hidden, shapes, charts: Object.values(Chart.instances) };
})();
