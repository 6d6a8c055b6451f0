"use strict";
// The page of coseg edit: shows shapes, sends what a person does to the server, and shows what follows.
(function () {
  const percent = (share) => (100 * share).toFixed(0) + " %";
  const root = location.pathname.replace(/[^/]*$/, "");

  let state = null;
  let current = -1;      // the shape in the large view
  let chosen = 0;        // the part that a click paints
  let brush = "patch";
  let merging = false;   // M was pressed; the next number names the other part
  let busy = false;

  // How acts name the shape in the large view: its name, and the bytes of one that is not UTF-8.
  function shapeNow() {
    const shape = state.shapes[current];
    return shape.name_bytes ? { shape: shape.name, shape_bytes: shape.name_bytes } : { shape: shape.name };
  }

  function say(text, isBad) {
    element("message").textContent = text;
    element("message").classList.toggle("bad", !!isBad);
  }

  // ---- the server

  async function ask(path, options) {
    const reply = await fetch(root + path, options);
    if (reply.headers.get("Content-Type").startsWith("application/json")) {
      const answer = await reply.json();
      if (!reply.ok) throw Object.assign(new Error(answer.error), { status: reply.status });
      return answer;
    }
    const text = await reply.text();
    if (!reply.ok) throw Object.assign(new Error(text), { status: reply.status });
    return text;
  }

  async function send(path, body) {
    if (busy) return false;
    busy = true;
    const begin = performance.now();
    try {
      const separator = path.includes("?") ? "&" : "?";
      await take(await ask(path + separator + "revision=" + state.revision, { method: "POST", body: body ? JSON.stringify(body) : "" }));
      const seconds = (performance.now() - begin) / 1000;
      window.cosegEdit.seconds = seconds;
      say((state.last || "nothing said yet") + ": " + state.changed.length + " of " + state.shapes.length + " shapes changed, " + seconds.toFixed(2) + " s");
      return true;
    } catch (error) {
      if (error.status === 409) await take(await ask("state"), true);
      say(error.status ? error.message : "the server does not answer; what was done before is kept in corrections.json", true);
      return false;
    } finally {
      busy = false;
    }
  }

  // What the server says is now; shapes that changed are drawn anew.
  async function take(next, all) {
    state = next;
    const changed = all ? state.shapes.map((_, number) => number) : state.changed;
    for (const number of changed) labels.delete(number);
    if (!state.parts.some((part) => part.number === chosen)) chosen = state.parts[0].number;
    showParts();
    showTools();
    for (const tile of tiles) tile.describe();
    await drawCurrent();
    if (all || changed.length) recolor(new Set(changed));
    else recolor(new Set(tiles.map((_, number) => number)));  // names and colours may be others
    showQuestion();
  }

  async function showQuestion() {
    const question = await ask("next");
    window.cosegEdit.next = question.shape;
    element("next").disabled = question.shape < 0;
    element("reason").textContent = question.shape < 0 ? question.reason : "Next: " + state.shapes[question.shape].name + ", because " + question.reason + ".";
  }

  // ---- shapes and labels, fetched when they are first looked at

  const solids = new Map();
  const labels = new Map();

  function cached(map, number, find) {
    if (!map.has(number)) {
      const found = find();
      map.set(number, found);
      found.catch(() => map.delete(number));
    }
    return map.get(number);
  }

  const solidOf = (number) => cached(solids, number, async () => {
    const buffer = Uint8Array.from(atob(await ask("mesh/" + number)), (c) => c.charCodeAt(0)).buffer;
    const [vertices, faces] = new Uint32Array(buffer, 0, 2);
    const places = new Uint16Array(buffer, 8, 3 * vertices);
    let at = 8 + 6 * vertices;
    at += at % 4;
    const corners = new Uint32Array(buffer, at, 3 * faces);
    const face = new Uint32Array(buffer, at + 12 * faces, faces);
    const positions = new Float32Array(9 * faces);
    for (let i = 0; i < 3 * faces; ++i)
      for (let k = 0; k < 3; ++k) positions[3 * i + k] = places[3 * corners[i] + k] / 32767.5 - 1;
    return { positions, face };
  });

  const runs = (text) => text.split(",").flatMap((run) => {
    const [label, count] = run.split("*");
    return new Array(Number(count || 1)).fill(Number(label));
  });

  const labelsOf = (number) => cached(labels, number, async () => {
    const answer = await ask("labels/" + number);
    return { part: runs(answer.labels), patch: runs(answer.patches) };
  });

  const colorOf = (part) => {
    const row = state.parts.find((p) => p.number === part);
    return new THREE.Color(row && row.color ? row.color : data.colors[part % data.colors.length]);
  };

  async function meshOf(number) {
    const [solid, label] = await Promise.all([solidOf(number), labelsOf(number)]);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(solid.positions, 3));
    const colors = new Float32Array(solid.positions.length);
    const known = new Map();
    solid.face.forEach((face, triangle) => {
      const part = label.part[face];
      if (!known.has(part)) known.set(part, colorOf(part));
      const color = known.get(part);
      for (let k = 0; k < 3; ++k) colors.set([color.r, color.g, color.b], 9 * triangle + 3 * k);
    });
    geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    geometry.computeVertexNormals();
    const material = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors, side: THREE.DoubleSide });
    return new THREE.Mesh(geometry, material);
  }

  function sceneAndCamera() {
    const scene = new THREE.Scene();
    const camera = new THREE.PerspectiveCamera(28, 1, 0.05, 50);
    const [up, towards] = [new THREE.Vector3(...data.up), new THREE.Vector3(...data.towards)];
    camera.up.copy(up);
    camera.position.copy(towards).multiplyScalar(4.6);
    camera.lookAt(0, 0, 0);
    scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8a90, 0.62));
    scene.children[0].position.copy(up);
    const lamp = new THREE.DirectionalLight(0xffffff, 0.5);
    lamp.position.set(-0.6, 0.8, 0.9);
    camera.add(lamp);
    scene.add(camera);
    return { scene, camera };
  }

  const dispose = (mesh) => { mesh.geometry.dispose(); mesh.material.dispose(); };

  // ---- the large view

  const canvas = element("view");
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  renderer.setClearColor(0xf7f7f5);
  renderer.setPixelRatio(window.devicePixelRatio || 1);
  const large = sceneAndCamera();
  const controls = new THREE.OrbitControls(large.camera, canvas);
  controls.addEventListener("change", draw);
  let shown = null;

  function draw() {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width || !shown) return;
    renderer.setSize(width, height, false);
    large.camera.aspect = width / height;
    large.camera.updateProjectionMatrix();
    renderer.render(large.scene, large.camera);
  }

  async function drawCurrent() {
    if (current < 0) return;
    const number = current;
    const mesh = await meshOf(number);
    if (number !== current) return dispose(mesh);
    if (shown) { large.scene.remove(shown); dispose(shown); }
    shown = mesh;
    large.scene.add(mesh);
    const shape = state.shapes[number];
    element("shapeName").textContent = shape.name + ": " + (shape.confirmed ? "confirmed" : percent(shape.confidence) + " sure");
    draw();
  }

  async function show(number) {
    current = number;
    for (const [k, tile] of tiles.entries()) tile.box.classList.toggle("shown", k === number);
    tiles[number].box.scrollIntoView({ block: "nearest" });
    await drawCurrent();
  }

  const ray = new THREE.Raycaster();
  async function faceAt(event) {
    const box = canvas.getBoundingClientRect();
    const place = new THREE.Vector2(2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height);
    ray.setFromCamera(place, large.camera);
    const hit = shown && ray.intersectObject(shown)[0];
    return hit ? (await solidOf(current)).face[hit.faceIndex] : -1;
  }

  let press = null;
  canvas.addEventListener("pointerdown", (event) => {
    press = { x: event.clientX, y: event.clientY, stroke: event.shiftKey ? new Set() : null };
    if (event.shiftKey) controls.enabled = false;
  }, true);
  canvas.addEventListener("pointermove", async (event) => {
    const stroke = press && press.stroke;
    if (!stroke) return;
    const face = await faceAt(event);
    if (face >= 0) stroke.add(face);
  });
  canvas.addEventListener("pointerup", async (event) => {
    const begun = press;
    press = null;
    controls.enabled = true;
    if (!begun || event.button !== 0) return;
    const face = await faceAt(event);
    if (begun.stroke) {
      if (face >= 0) begun.stroke.add(face);
      const faces = [...begun.stroke].sort((a, b) => a - b);
      if (faces.length) await send("act", { act: "label", part: chosen, ...shapeNow(), faces: faces.join(",") });
      return;
    }
    if (Math.hypot(event.clientX - begun.x, event.clientY - begun.y) > 4 || face < 0) return;
    await send("label/" + current + "?face=" + face + "&region=" + brush + "&part=" + chosen);
  });

  // ---- the parts

  const partName = (number) => state.parts.find((part) => part.number === number).name;
  const merge = (part, into) => part !== into && send("act", { act: "merge", part, into });

  // A part that is dragged on another one; pointers of any kind can do it.
  let dragged = -1;
  const rowUnder = (event) => {
    const found = document.elementFromPoint(event.clientX, event.clientY);
    const row = found && found.closest(".part");
    return row && Number(row.dataset.part) !== dragged ? row : null;
  };
  document.addEventListener("pointermove", (event) => {
    if (dragged < 0) return;
    const under = rowUnder(event);
    for (const row of element("parts").children) row.classList.toggle("over", row === under);
  });
  document.addEventListener("pointerup", (event) => {
    const row = dragged >= 0 ? rowUnder(event) : null;
    const part = dragged;
    dragged = -1;
    for (const other of element("parts").children) other.classList.remove("over");
    if (row) merge(part, Number(row.dataset.part));
  });

  function showParts() {
    const list = element("parts");
    list.replaceChildren();
    state.parts.forEach((part, k) => {
      const row = make("div", list, undefined, "part");
      row.dataset.part = part.number;
      row.tabIndex = 0;
      row.setAttribute("role", "radio");
      row.setAttribute("aria-checked", part.number === chosen);
      make("span", row, k < 9 ? String(k + 1) : "", "faint");
      const color = make("input", row);
      color.type = "color";
      color.value = "#" + colorOf(part.number).getHexString();
      color.setAttribute("aria-label", "colour of " + part.name);
      color.addEventListener("change", () => send("act", { act: "color", part: part.number, color: color.value }));
      const name = make("input", row);
      name.type = "text";
      name.value = part.name;
      name.maxLength = 60;
      name.setAttribute("aria-label", "name of " + part.name);
      name.addEventListener("change", () => send("act", { act: "name", part: part.number, name: name.value }));
      make("span", row, percent(part.area), "faint");
      const choose = () => { chosen = part.number; showChosen(); };
      row.addEventListener("click", choose);
      row.addEventListener("keydown", (event) => { if (event.target === row && (event.key === " " || event.key === "Enter")) { choose(); event.preventDefault(); event.stopPropagation(); } });
      row.addEventListener("pointerdown", (event) => { if (event.target.tagName !== "INPUT") { dragged = part.number; event.preventDefault(); } });
    });
    showChosen();
  }

  function showChosen() {
    for (const row of element("parts").children) row.setAttribute("aria-checked", Number(row.dataset.part) === chosen);
    const part = state.parts.find((p) => p.number === chosen);
    element("split").disabled = !part.can_split;
  }

  function showTools() {
    element("undo").disabled = state.acts === 0;
    element("redo").disabled = state.undone === 0;
    const isFirst = state.acts === 0 || (state.acts === 1 && state.last.startsWith("level"));
    element("levelBox").hidden = state.levels === 0;
    element("level").disabled = !isFirst;
    element("level").max = state.levels;
    element("level").value = isFirst ? state.parts.length : element("level").value;
    element("levelText").textContent = state.parts.length + " parts";
  }

  // ---- all shapes

  const small = sceneAndCamera();
  const smallRenderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  smallRenderer.setClearColor(0xffffff);
  smallRenderer.setSize(264, 208, false);
  small.camera.aspect = 264 / 208;
  small.camera.updateProjectionMatrix();
  const tiles = [];
  const visible = new Set();

  class Tile {
    constructor(number) {
      this.number = number;
      this.box = make("button", element("gallery"), undefined, "tile");
      this.box.dataset.number = number;
      this.canvas = make("canvas", this.box);
      this.canvas.width = 264;
      this.canvas.height = 208;
      this.name = make("span", this.box, undefined, "name");
      this.note = make("span", this.box, undefined, "faint");
      this.isFresh = false;
      this.box.addEventListener("click", () => show(number));
    }
    describe() {
      const shape = state.shapes[this.number];
      this.name.textContent = shape.name;
      this.note.textContent = shape.confirmed ? "\u2713 confirmed" : percent(shape.confidence) + " sure";
    }
    async paint() {
      if (this.isFresh) return;
      this.isFresh = true;
      const mesh = await meshOf(this.number);
      small.scene.add(mesh);
      smallRenderer.render(small.scene, small.camera);
      this.canvas.getContext("2d").drawImage(smallRenderer.domElement, 0, 0);
      small.scene.remove(mesh);
      dispose(mesh);
    }
  }

  function recolor(numbers) {
    for (const number of numbers) tiles[number].isFresh = false;
    for (const number of visible) tiles[number].paint();
  }

  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const number = Number(entry.target.dataset.number);
      if (entry.isIntersecting) { visible.add(number); tiles[number].paint(); }
      else visible.delete(number);
    }
  });

  // ---- buttons and keys

  for (const [name, text] of [["patch", "patch (P)"], ["piece", "whole piece (H)"], ["face", "face (F)"]]) {
    const button = make("button", element("brushes"), text);
    button.id = "brush-" + name;
    button.setAttribute("role", "radio");
    button.addEventListener("click", () => setBrush(name));
  }
  function setBrush(name) {
    brush = name;
    for (const button of element("brushes").children) button.setAttribute("aria-checked", button.id === "brush-" + name);
  }

  async function confirmShape() {
    if (await send("confirm/" + current) && window.cosegEdit.next >= 0) await showNext();
  }
  async function showNext() {
    const question = await ask("next");
    if (question.shape >= 0) await show(question.shape);
  }

  const on = (id, act) => element(id).addEventListener("click", act);
  on("undo", () => send("undo"));
  on("redo", () => send("redo"));
  on("next", showNext);
  on("confirm", confirmShape);
  on("absent", () => send("act", { act: "absent", part: chosen, ...shapeNow() }));
  on("newPart", async () => { if (await send("act", { act: "new-part" })) { chosen = state.parts[state.parts.length - 1].number; showChosen(); } });
  on("split", () => send("act", { act: "split", part: chosen }));
  on("save", async () => { try { say("written into " + (await ask("save", { method: "POST" })).folder); } catch (error) { say(error.message, true); } });
  on("end", async () => { await ask("end", { method: "POST" }); say("The server has ended. What you said is in corrections.json."); });
  element("level").addEventListener("change", () => send("act", { act: "level", parts: Number(element("level").value) }));
  element("level").addEventListener("input", () => { element("levelText").textContent = element("level").value + " parts"; });

  document.addEventListener("keydown", (event) => {
    if (event.target.tagName === "INPUT") return;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z") { event.preventDefault(); return void send(event.shiftKey ? "redo" : "undo"); }
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "y") { event.preventDefault(); return void send("redo"); }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const number = "123456789".indexOf(event.key);
    if (event.key.length === 1 && number >= 0 && number < state.parts.length) {
      const other = state.parts[number].number;
      if (merging) { merging = false; return void merge(chosen, other); }
      chosen = other;
      return showChosen();
    }
    merging = false;
    const isButton = event.target.tagName === "BUTTON";
    const keys = {
      n: showNext, p: () => setBrush("patch"), h: () => setBrush("piece"), f: () => setBrush("face"),
      a: () => element("absent").click(),
      m: () => { merging = true; say("merge " + partName(chosen) + " into which part? Press its number."); },
      ArrowRight: () => show((current + 1) % state.shapes.length),
      ArrowLeft: () => show((current + state.shapes.length - 1) % state.shapes.length),
      Enter: isButton ? undefined : confirmShape,
    };
    const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (act) { event.preventDefault(); act(); }
  });
  // A button that was clicked does not take the next key: Enter confirms the shape again.
  document.addEventListener("click", (event) => {
    const button = event.target.closest("button");
    if (button && event.detail > 0) button.blur();
  });
  window.addEventListener("resize", draw);

  window.cosegEdit = { get state() { return state; }, get current() { return current; }, labelsOf, solidOf, camera: large.camera, next: -1, seconds: 0, ready: false };
  (async function () {
    try {
      setBrush("patch");
      const first = await ask("state");
      first.shapes.forEach((_, number) => tiles.push(new Tile(number)));
      await take(first, true);
      for (const tile of tiles) watcher.observe(tile.box);
      const question = await ask("next");
      await show(Math.max(question.shape, 0));
      window.cosegEdit.ready = true;
    } catch (error) {
      say(error.message, true);
    }
  })();
})();
