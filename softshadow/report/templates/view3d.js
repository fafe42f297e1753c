// Draws the line of sight of a pixel into trimesh's viewer, whose globals are THREE, scene, camera, controls, renderer and render.
(() => {
  const view = JSON.parse(document.getElementById("view").textContent);
  const RAY = 0xb3261e, LAMP = 0xb8860b, UP = 0xd55e00, DOWN = 0x0072b2, UNCOUNTED = 0x808080;
  const LABEL = 0.03;  // height, as a share of the picture's
  const SAME = 1e-6;  // depths that differ by less, relative, are on the surface
  const SEEN_THROUGH = {transparent: true, opacity: 0.6, depthWrite: false};  // failing fragments lie behind the surface
  const sight = new THREE.Group();
  const kinds = new Map();  // "volume" -> its objects
  const inputs = ["pixel-x", "pixel-y"].map(id => document.getElementById(id));
  const table = document.getElementById("crossings");
  const vector = values => new THREE.Vector3(...values);
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const along = (direction, t) => view.eye.map((e, i) => e + t * direction[i]);

  // -- crossings ----------------------------------------------------------------------------------------------------
  const direction = (x, y) => view.corner.map((c, i) => c + (x + 0.5) * view.right[i] + (y + 0.5) * view.down[i] - view.eye[i]);

  // where the ray meets a piece: t in units of the direction, which ends on the near plane, and whether it enters
  function meetings(piece, towards) {
    const places = piece.geometry.getAttribute("position").array, indices = piece.geometry.index.array, met = [];
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map(k => minus(places.slice(3 * indices[i + k], 3 * indices[i + k] + 3), view.eye));
      const sides = [dot(cross(a, b), towards), dot(cross(b, c), towards), dot(cross(c, a), towards)];
      if (!(sides.every(s => s >= 0) || sides.every(s => s <= 0))) continue;
      const normal = cross(minus(b, a), minus(c, a)), slope = dot(normal, towards);
      const t = dot(normal, a) / slope;
      if (slope !== 0 && t >= 1) met.push({t, enters: slope < 0, piece});
    }
    return met;
  }

  function surfaceAt(towards) {
    const objects = ["caster", "receiver", "object"].flatMap(kind => kinds.get(kind) ?? []);
    const nearest = Math.min(...objects.flatMap(piece => meetings(piece, towards)).map(m => m.t));
    return nearest <= (view.farthest ?? Infinity) ? nearest : Infinity;
  }

  // the crossings in the order of the count: from the eye where the depth test passes, from infinity where it fails
  function lineOf(x, y) {
    const towards = direction(x, y), surface = surfaceAt(towards);
    const line = {x, y, point: isFinite(surface) ? along(towards, surface) : null, start: 0, end: null, crossings: []};
    if (!view.counting || !line.point) return line;
    const faces = (kinds.get("volume") ?? []).flatMap(piece => meetings(piece, towards)).sort((a, b) => a.t - b.t);
    const before = faces.filter(face => face.t < surface * (1 - SAME)), behind = faces.filter(face => face.t >= surface * (1 - SAME));
    const failing = view.counting === "failing", parity = view.counting === "parity";
    if (!failing && view.start !== "none") line.start = faces.reduce((sum, face) => sum + (face.enters ? -1 : 1), 0);
    let count = line.start;
    for (const face of failing ? behind.reverse() : before) {
      const change = face.enters !== failing ? 1 : -1;
      count = parity ? 1 - count : count + change;
      line.crossings.push({place: along(towards, face.t), change, count, face: face.piece.userData.face});
    }
    for (const face of failing ? before : behind) {
      line.crossings.push({place: along(towards, face.t), change: 0, count: null, face: face.piece.userData.face});
    }
    line.end = count;
    return line;
  }

  // -- drawing ------------------------------------------------------------------------------------------------------
  const size = view.extent;
  const plain = color => new THREE.MeshBasicMaterial({color});

  function rod(from, to, color, radius, opacity = 1) {
    const [a, b] = [vector(from), vector(to)], axis = b.clone().sub(a);
    const material = plain(color);
    Object.assign(material, {transparent: opacity < 1, opacity});
    const mesh = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, axis.length(), 8), material);
    mesh.position.copy(a).addScaledVector(axis, 0.5);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), axis.normalize());
    sight.add(mesh);
  }

  function ball(place, color, radius = view.marker) {
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(radius * size, 16, 12), plain(color));
    Object.assign(mesh.material, {transparent: true, depthTest: false});  // seen through what stands before it
    mesh.renderOrder = 1;
    mesh.position.copy(vector(place));
    sight.add(mesh);
  }

  function label(place, text, color, row = 0) {
    const canvas = document.createElement("canvas"), pen = canvas.getContext("2d");
    const font = "bold 44px system-ui, sans-serif";
    pen.font = font;
    [canvas.width, canvas.height] = [Math.ceil(pen.measureText(text).width) + 24, 60];
    Object.assign(pen, {font, fillStyle: "#fff", textBaseline: "middle", strokeStyle: `#${color.toString(16).padStart(6, "0")}`, lineWidth: 4});
    pen.beginPath(); pen.roundRect(2, 2, canvas.width - 4, 56, 12); pen.fill(); pen.stroke();
    pen.fillStyle = "#111"; pen.fillText(text, 12, 31);
    const map = new THREE.CanvasTexture(canvas);
    map.minFilter = THREE.LinearFilter;
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map, depthTest: false, sizeAttenuation: false}));
    sprite.scale.set(LABEL * canvas.width / canvas.height, LABEL, 1);
    sprite.center.set(0.5, -0.4 - 1.05 * row);  // labels of neighbouring crossings stand one above the other
    sprite.position.copy(vector(place));
    sprite.renderOrder = 2;
    sight.add(sprite);
  }

  const signed = change => change > 0 ? `+${change}` : `\u2212${-change}`;
  const changeOf = each => each.count === null ? "" : view.counting === "parity" ? "invert" : signed(each.change);

  function draw(line, stencil) {
    for (const old of [...sight.children]) { sight.remove(old); old.geometry?.dispose(); old.material.map?.dispose(); old.material.dispose(); }
    const towards = direction(line.x, line.y), length = Math.hypot(...towards), end = along(towards, view.reach / length);
    rod(view.eye, line.point ?? end, RAY, 0.002 * size);
    ball(view.eye, RAY, 1.3 * view.marker);
    label(view.eye, "eye", RAY, -1.8);
    if (line.point) {
      ball(line.point, RAY);
      label(line.point, "P", RAY, -1.8);
      rod(line.point, end, RAY, 0.001 * size, 0.4);
      const light = view.light[3] ? view.light.slice(0, 3) : line.point.map((p, i) => p + view.light[i] / Math.hypot(...view.light) * size);
      rod(line.point, light, LAMP, 0.001 * size, 0.7);
    }
    const key = each => each.count === null ? UNCOUNTED : each.change > 0 ? UP : DOWN;
    line.crossings.forEach((each, i) => {
      ball(each.place ?? end, key(each));
      if (each.count !== null) label(each.place ?? end, `${changeOf(each)} = ${each.count}`, key(each), i % 4);
    });
    tell(line, stencil, key);
    render();
  }

  function tell(line, stencil, key) {
    table.replaceChildren();
    const say = text => table.appendChild(Object.assign(document.createElement("p"), {textContent: text}));
    if (!line.point) say("The pixel shows no surface.");
    if (!view.counting) return void say("This technique counts no faces.");
    const counted = line.crossings.filter(each => each.count !== null);
    const from = view.counting === "failing" ? "Behind the surface, from infinity" : "From the eye to the surface";
    say(`${from}, starting from ${line.start}: ${counted.length === 0 ? "no face is counted." : ""}`);
    const rows = document.createElement("table");
    line.crossings.forEach((each, i) => {
      const row = rows.insertRow();
      for (const text of [each.count === null ? "" : i + 1, changeOf(each) || "not counted", each.count ?? "", each.face]) row.insertCell().textContent = text;
      const dot = Object.assign(document.createElement("span"), {className: "key"});
      dot.style.background = `#${key(each).toString(16).padStart(6, "0")}`;
      row.cells[0].prepend(dot);
    });
    if (line.crossings.length) table.appendChild(rows);
    const last = counted.length ? counted.at(-1).count : line.start;
    say(`Stencil value ${stencil ?? line.end ?? last}${last ? ": in shadow." : "."}`);
    if (stencil !== undefined && (last & 255) !== stencil) {
      say(`The line counts ${last} and the stencil buffer has ${stencil}: the pixel's centre lies on an edge.`);
    }
    table.dataset.count = last;
  }

  // -- the page -----------------------------------------------------------------------------------------------------
  function choose(x, y, stencil) {
    if (!(x >= 0 && y >= 0 && x < view.size[0] && y < view.size[1])) return;
    [inputs[0].value, inputs[1].value] = [x, y];
    const recorded = view.line && view.line.x === x && view.line.y === y;
    draw(recorded ? view.line : lineOf(x, y), stencil);
  }

  function addSwitches() {
    const set = document.getElementById("kinds");
    for (const [kind, pieces] of kinds) {
      const box = Object.assign(document.createElement("input"), {type: "checkbox", checked: pieces[0].visible, name: kind});
      box.addEventListener("change", () => { for (const piece of pieces) piece.visible = box.checked; render(); });
      const text = document.createElement("label");
      text.append(box, ` ${kind}`);
      set.append(text);
    }
  }

  // from the side, so that the line of sight is seen in its length: the eye on one side, the casters on the other
  function look() {
    const up = vector(view.up).normalize(), middle = vector(view.middle), eye = vector(view.eye);
    const places = [eye, middle, ...view.light[3] ? [vector(view.light.slice(0, 3))] : []];
    const target = new THREE.Box3().setFromPoints(places).getCenter(new THREE.Vector3()).lerp(middle, 0.3);
    const radius = 1.15 * Math.max(...places.map(place => place.distanceTo(target)));
    const back = eye.clone().sub(middle).applyAxisAngle(up, 1).addScaledVector(up, 0.1 * radius).normalize();
    camera.fov = 45;
    const narrow = Math.min(1, (innerWidth - panelWidth()) / innerHeight);
    camera.position.copy(target).addScaledVector(back, radius / Math.sin(Math.PI / 8) / narrow);
    camera.up.copy(up);
    Object.assign(camera, {near: radius / 100, far: 100 * (radius + view.reach)});
    controls.target.copy(target);
    controls.update();
    besidePanel();
  }

  const panel = document.getElementById("panel");
  const panelWidth = () => panel.open && innerWidth > 700 ? panel.offsetWidth : 0;

  // the middle of the picture is the middle of what the panel leaves free
  function besidePanel() {
    camera.setViewOffset(innerWidth, innerHeight, -panelWidth() / 2, 0, innerWidth, innerHeight);
    render();
  }

  function start() {
    scene.traverse(each => {
      const name = each.userData.name;
      if (!each.geometry || !name) return;
      const [kind, ...rest] = name.split("/");
      kinds.set(kind, [...kinds.get(kind) ?? [], each]);
      if (kind === "volume") each.userData.face = `${rest.at(-1).replace("sides", "side")} of ${rest.slice(1, -1).join("/")}`;
      if (kind === "frustum" || kind === "wedges") {
        each.add(new THREE.LineSegments(new THREE.EdgesGeometry(each.geometry), new THREE.LineBasicMaterial({color: LAMP})));
      }
    });
    scene.add(sight);
    scene.add(new THREE.AmbientLight(0xffffff, 0.45));
    tracklight.intensity = 0.75;
    for (const piece of kinds.get("receiver") ?? []) Object.assign(piece.material, SEEN_THROUGH);
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    scene.background = new THREE.Color(dark ? 0x16181d : 0xffffff);
    renderer.domElement.setAttribute("role", "img");
    renderer.domElement.setAttribute("aria-label", `${document.title}; the numbers are in the table`);
    addSwitches();
    look();
    panel.addEventListener("toggle", besidePanel);
    addEventListener("resize", besidePanel);
    panel.open = innerWidth > 700;
    for (const input of inputs) input.addEventListener("input", () => choose(inputs[0].valueAsNumber, inputs[1].valueAsNumber));
    addEventListener("message", event => {
      const message = event.data;
      if (message?.softshadow === "pixel") choose(message.x, message.y, message.stencil);
    });
    if (view.line) choose(view.line.x, view.line.y);
    render();
    window.view3d = {choose, lineOf};
    if (parent !== window) parent.postMessage({softshadow: "view3d"}, "*");
  }

  const wait = setInterval(() => {
    if (!controls) return;
    clearInterval(wait);
    start();
  }, 20);
})();
