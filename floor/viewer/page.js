// The viewer of `gramap view`: reads the glTF that stands in the page, leaves out the faces in which solids abut,
// merges meshes by material and place (a floor of a thousand rooms is then some dozen draw calls, of which a walker
// needs few), and shows it to orbit, to walk and as a plan. Without a graphics card it draws a sketch of the floor while
// the view moves, and the floor itself when it stands.
(function () {
  'use strict';
  const THREE = window.THREE;
  const $ = (id) => document.getElementById(id);
  const state = Object.fromEntries(new URLSearchParams(location.hash.slice(1)));

  // ---- the model: nodes, things (nodes with extras.gramap), triangles ----
  const text = atob($('model').textContent), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  const jsonLength = new DataView(bytes.buffer).getUint32(12, true);
  const gltf = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + jsonLength)));
  const data = 28 + jsonLength;

  function accessor(index) {
    const a = gltf.accessors[index], view = gltf.bufferViews[a.bufferView];
    const width = { SCALAR: 1, VEC3: 3 }[a.type];
    const Type = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array }[a.componentType];
    return new Type(bytes.buffer, data + (view.byteOffset || 0) + (a.byteOffset || 0), a.count * width);
  }

  const kTile_m = 60;   // what lies in one tile is drawn at once
  const kHandle_m = 0.035;  // door handles are not drawn where a pixel is larger than this
  const kSliver_m = 0.07;   // nor are a sketch's triangles narrower than this where a pixel is larger
  const things = [];
  const buckets = new Map();
  const origin = { x: 0, y: 0 };
  for (const node of gltf.nodes) {
    const local = node.extras && node.extras.gramap && node.extras.gramap.local_origin;
    if (local) { origin.x = local[0]; origin.y = local[1]; }
  }

  function visit(index, matrix, thing, floor) {
    const node = gltf.nodes[index];
    const about = node.extras && node.extras.gramap;
    if (about) {
      thing = { node: node.name, label: node.extras.Name, about: about, floor: floor };
      if (about.kind === 'floor') floor = thing;
      things.push(thing);
    }
    const local = new THREE.Matrix4().compose(
      new THREE.Vector3().fromArray(node.translation || [0, 0, 0]),
      new THREE.Quaternion().fromArray(node.rotation || [0, 0, 0, 1]), new THREE.Vector3(1, 1, 1));
    const world = new THREE.Matrix4().multiplyMatrices(matrix, local);
    if (node.mesh !== undefined && !/_volume$/.test(node.name)) {
      const kind = thing ? thing.about.kind : '';
      const layer = /_ceiling$/.test(node.name) ? 'ceilings' : kind === 'furniture' ? 'furniture'
        : kind === 'door' || kind === 'window' ? 'openings' : 'building';
      const masonry = kind === 'wall' || /slab$/.test(node.name), tiny = kind === 'door' && /_handle(_2)?(_far)?$/.test(node.name);
      for (const primitive of gltf.meshes[node.mesh].primitives) add(layer, primitive, world, thing, masonry, tiny);
    }
    for (const child of node.children || []) visit(child, world, thing, floor);
  }

  function add(layer, primitive, world, thing, masonry, tiny) {
    const given = accessor(primitive.attributes.POSITION), turned = accessor(primitive.attributes.NORMAL);
    const part = {
      layer: layer, material: primitive.material, thing: thing, masonry: masonry, tiny: tiny,
      position: new Float32Array(given.length), normal: new Float32Array(given.length), index: accessor(primitive.indices),
    };
    const p = new THREE.Vector3(), turn = new THREE.Matrix3().getNormalMatrix(world);
    for (let i = 0; i < given.length; i += 3) {
      p.fromArray(given, i).applyMatrix4(world).toArray(part.position, i);
      p.fromArray(turned, i).applyMatrix3(turn).toArray(part.normal, i);
    }
    parts.push(part);
  }

  // Where two solids of masonry abut, both have the same triangles, facing each other. Nobody can see them, but
  // their upper edges lie in the faces that one does see, and would shimmer through and cast shadows there.
  function dropHiddenFaces(parts) {
    const numbers = new Map(), faces = new Map();
    const number = (part, corner) => {
      const i = 3 * corner, key = part.position[i] + ',' + part.position[i + 1] + ',' + part.position[i + 2];
      if (!numbers.has(key)) numbers.set(key, numbers.size);
      return numbers.get(key);
    };
    for (const part of parts) {
      const own = [];
      for (let point = 0; point < part.position.length / 3; ++point) own.push(number(part, point));
      for (let t = 0; t < part.index.length; t += 3) {
        const key = [own[part.index[t]], own[part.index[t + 1]], own[part.index[t + 2]]].sort((a, b) => a - b).join();
        if (faces.has(key)) faces.get(key).push([part, t]); else faces.set(key, [[part, t]]);
      }
    }
    const hidden = new Map();
    for (const pair of faces.values())
      if (pair.length === 2)
        for (const [part, t] of pair) {
          if (!hidden.has(part)) hidden.set(part, new Set());
          hidden.get(part).add(t);
        }
    for (const [part, gone] of hidden)
      part.index = part.index.filter((_, corner) => !gone.has(corner - (corner % 3)));
  }

  const parts = [];
  for (const root of gltf.scenes[gltf.scene || 0].nodes) visit(root, new THREE.Matrix4(), null, null);
  dropHiddenFaces(parts.filter((part) => part.masonry));
  function tileOf(part) {
    return Math.round(part.position[0] / kTile_m) + '|' + Math.round(part.position[2] / kTile_m);
  }
  for (const part of parts) {
    const key = [part.layer, part.material, part.tiny, tileOf(part)].join('|');
    if (!buckets.has(key)) buckets.set(key, { layer: part.layer, material: part.material, tiny: part.tiny, parts: [], points: 0, corners: 0 });
    const bucket = buckets.get(key);
    part.first = bucket.corners / 3;
    bucket.parts.push(part);
    bucket.points += part.position.length / 3;
    bucket.corners += part.index.length;
  }
  const rooms = things.filter((t) => ['room', 'hallway', 'fixed'].includes(t.about.kind));
  const floors = things.filter((t) => t.about.kind === 'floor');

  // ---- the scene ----
  function colourOf(material) {
    return gltf.materials[material].pbrMetallicRoughness.baseColorFactor;
  }
  function clarity(material) {
    const alpha = colourOf(material)[3], clear = alpha !== undefined && alpha < 1;
    return { transparent: clear, opacity: clear ? alpha : 1, depthWrite: !clear };
  }
  const scene = new THREE.Scene();
  const layers = {};
  const details = [], materials = new Map();
  let triangles = 0;
  for (const bucket of buckets.values()) {
    const position = new Float32Array(bucket.points * 3), normal = new Float32Array(bucket.points * 3);
    const index = new Uint32Array(bucket.corners);
    let point = 0, corner = 0;
    for (const part of bucket.parts) {
      position.set(part.position, point * 3);
      normal.set(part.normal, point * 3);
      for (let i = 0; i < part.index.length; ++i) index[corner + i] = part.index[i] + point;
      point += part.position.length / 3;
      corner += part.index.length;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(position, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(normal, 3));
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
    if (!materials.has(bucket.material)) {
      const [r, g, b] = colourOf(bucket.material);
      materials.set(bucket.material, new THREE.MeshLambertMaterial({ name: gltf.materials[bucket.material].name, color: new THREE.Color(r, g, b), ...clarity(bucket.material) }));
    }
    const mesh = new THREE.Mesh(geometry, materials.get(bucket.material));
    mesh.receiveShadow = !mesh.material.transparent;
    mesh.userData.parts = bucket.parts;
    if (bucket.tiny) details.push({ mesh: mesh, size_m: kHandle_m });
    layers[bucket.layer] = layers[bucket.layer] || new THREE.Group();
    layers[bucket.layer].add(mesh);
    triangles += bucket.corners / 3;
  }
  Object.values(layers).forEach((group) => scene.add(group));

  const box = new THREE.Box3().setFromObject(scene);
  const middle = box.getCenter(new THREE.Vector3()), extent = box.getSize(new THREE.Vector3());
  const radius = extent.length() / 2;
  const sky = new THREE.HemisphereLight(0xffffff, 0xdfd9cf, 0.66);
  sky.position.set(0.3, 1, -0.15);  // aslant, so that no two sides in the shade look the same
  const sun = new THREE.DirectionalLight(0xfff4e2, 0.42);
  sun.target.position.copy(middle);
  scene.add(sky, sun, sun.target);

  /// In the open the sun shines and everything casts shadows. In a room the light comes from its ceiling, and only
  /// furniture does; a plan has no shadows.
  const lights = {
    open: { from: [-0.55, 1, 0.35], sun: 0.42, sky: 0.66, casters: ['building', 'openings', 'furniture', 'ceilings'] },
    room: { from: [0.12, 1, 0.08], sun: 0.26, sky: 0.78, casters: ['furniture'] },
    plan: { from: [-0.2, 1, 0.12], sun: 0.36, sky: 0.72, casters: [] },
  };
  function light(name) {
    const mode = lights[name];
    sun.position.copy(middle).add(new THREE.Vector3(...mode.from).multiplyScalar(2 * radius));
    sun.intensity = mode.sun;
    sky.intensity = mode.sky;
    sun.castShadow = mode.casters.length > 0;
    if (sketch) sketch.paint();
    for (const [layer, group] of Object.entries(layers))
      for (const mesh of group.children) mesh.castShadow = !mesh.material.transparent && mode.casters.includes(layer);
    fitShadows();
  }

  /// The shadow map covers the floor as the sun sees it, as tightly as it can.
  function fitShadows() {
    const map = sun.shadow.mapSize.set(4096, 4096), eye = sun.shadow.camera, seen = new THREE.Box3();
    eye.position.copy(sun.position);
    eye.lookAt(middle);
    eye.updateMatrixWorld();
    const toSun = new THREE.Matrix4().getInverse(eye.matrixWorld);
    for (const x of [box.min.x, box.max.x])
      for (const y of [box.min.y, box.max.y])
        for (const z of [box.min.z, box.max.z]) seen.expandByPoint(new THREE.Vector3(x, y, z).applyMatrix4(toSun));
    Object.assign(eye, {
      left: seen.min.x - 0.1, right: seen.max.x + 0.1, bottom: seen.min.y - 0.1, top: seen.max.y + 0.1,
      near: -seen.max.z - 1, far: -seen.min.z + 2 * extent.y + 1,
    });
    const texel = Math.max(eye.right - eye.left, eye.top - eye.bottom) / map.x;
    sun.shadow.bias = -Math.max(0.01, 1.5 * texel) / (eye.far - eye.near);
  }

  const ground = new THREE.Mesh(new THREE.PlaneBufferGeometry(8 * radius, 8 * radius), new THREE.ShadowMaterial({ opacity: 0.16 }));
  ground.rotation.x = -Math.PI / 2;
  ground.position.copy(middle).setY(box.min.y - 0.01);
  ground.receiveShadow = true;
  scene.add(ground);

  const selection = new THREE.Group();
  scene.add(selection);

  // ---- the sketch ----
  /// The floor as a machine without a graphics card can draw it many times a second: shadows and light, which cost it most,
  /// are left out and painted on, all colours are one material, and narrow faces of furniture and openings are
  /// drawn only where they are wider than a pixel.
  function makeSketch() {
    const made = { scene: new THREE.Scene(), layers: {}, materials: new Map(), details: [] }, bins = new Map();
    for (const part of parts) {
      const look = clarity(part.material), name = part.layer + '_' + look.opacity;
      if (!made.materials.has(name))
        made.materials.set(name, new THREE.MeshBasicMaterial({ name: name, vertexColors: THREE.VertexColors, ...look }));
      const key = [name, tileOf(part)].join('|');
      if (!bins.has(key)) bins.set(key, { layer: part.layer, material: made.materials.get(name), parts: [], wide: [], narrow: [], points: 0 });
      const bin = bins.get(key);
      bin.parts.push(part);
      const detailed = part.layer === 'furniture' || part.layer === 'openings';
      for (let t = 0; t < part.index.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => part.index[t + k]);
        const into = detailed && (part.tiny || widthOf(part.position, a, b, c) < kSliver_m) ? bin.narrow : bin.wide;
        into.push(a + bin.points, b + bin.points, c + bin.points);
      }
      bin.points += part.position.length / 3;
    }
    for (const bin of bins.values()) {
      const position = new Float32Array(3 * bin.points);
      let at = 0;
      for (const part of bin.parts) { position.set(part.position, at); at += part.position.length; }
      const positions = new THREE.BufferAttribute(position, 3);
      bin.colours = new THREE.BufferAttribute(new Float32Array(3 * bin.points), 3);
      made.layers[bin.layer] = made.layers[bin.layer] || new THREE.Group();
      for (const index of [bin.wide, bin.narrow]) {
        if (!index.length) continue;
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', positions);
        geometry.setAttribute('color', bin.colours);
        geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(index), 1));
        const mesh = new THREE.Mesh(geometry, bin.material);
        mesh.matrixAutoUpdate = false;
        made.layers[bin.layer].add(mesh);
        if (index === bin.narrow) made.details.push({ mesh: mesh, size_m: kSliver_m });
      }
      delete bin.wide;
      delete bin.narrow;
    }
    for (const group of Object.values(made.layers)) made.scene.add(group);
    /// The light of the lamps as they are, after Lambert, on every point.
    made.paint = () => {
      const up = sky.position.clone().normalize(), toSun = sun.position.clone().sub(sun.target.position).normalize();
      for (const bin of bins.values()) {
        const out = bin.colours.array;
        let at = 0;
        for (const part of bin.parts) {
          const colour = colourOf(part.material), n = part.normal;
          const side = part.layer === 'ceilings' && !walking ? -1 : 1;  // who does not walk sees them from above
          for (let i = 0; i < n.length; i += 3, at += 3) {
            const above = (side * (n[i] * up.x + n[i + 1] * up.y + n[i + 2] * up.z)) / 2 + 0.5;
            const facing = Math.max(0, side * (n[i] * toSun.x + n[i + 1] * toSun.y + n[i + 2] * toSun.z)) * sun.intensity;
            out[at] = colour[0] * (sky.intensity * (sky.groundColor.r + (sky.color.r - sky.groundColor.r) * above) + sun.color.r * facing);
            out[at + 1] = colour[1] * (sky.intensity * (sky.groundColor.g + (sky.color.g - sky.groundColor.g) * above) + sun.color.g * facing);
            out[at + 2] = colour[2] * (sky.intensity * (sky.groundColor.b + (sky.color.b - sky.groundColor.b) * above) + sun.color.b * facing);
          }
        }
        bin.colours.needsUpdate = true;
      }
    };
    return made;
  }
  /// A triangle's height on its longest side.
  function widthOf(p, a, b, c) {
    const side = (i, j) => Math.hypot(p[3 * i] - p[3 * j], p[3 * i + 1] - p[3 * j + 1], p[3 * i + 2] - p[3 * j + 2]);
    const [x, y, z] = [side(a, b), side(b, c), side(c, a)].sort((i, j) => j - i);
    const half = (x + y + z) / 2;
    return (2 * Math.sqrt(Math.max(0, half * (half - x) * (half - y) * (half - z)))) / x;
  }

  function drawnBySoftware() {
    const gl = document.createElement('canvas').getContext('webgl'), about = gl && gl.getExtension('WEBGL_debug_renderer_info');
    return !!about && /swiftshader|llvmpipe|softpipe|software|basic render/i.test(gl.getParameter(about.UNMASKED_RENDERER_WEBGL));
  }
  const software = drawnBySoftware();
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: !software, alpha: true });
  } catch (error) {
    $('view').innerHTML = '<p id="fault">This browser shows no 3D (WebGL is off). The table and the plan work without it.</p>';
  }
  const perspective = new THREE.PerspectiveCamera(50, 1, 0.05, 20 * radius + 100);
  const flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 4 * radius + 100);
  let camera = perspective, orbit = null, walking = false, yaw = 0, pitch = 0;
  if (renderer) {
    renderer.gammaOutput = true;
    renderer.localClippingEnabled = true;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = software ? THREE.BasicShadowMap : THREE.PCFShadowMap;
    renderer.shadowMap.autoUpdate = false;
    $('view').appendChild(renderer.domElement);
  }
  const sketch = renderer && software ? makeSketch() : null;

  /// How many metres a pixel is wide at the nearest point of a mesh.
  function pixel_m(mesh) {
    const height = $('view').clientHeight;
    if (camera === flat) return (flat.top - flat.bottom) / flat.zoom / height;
    if (!mesh.geometry.boundingSphere) mesh.geometry.computeBoundingSphere();
    const sphere = mesh.geometry.boundingSphere, away = perspective.position.distanceTo(sphere.center) - sphere.radius;
    return (2 * Math.max(0, away) * Math.tan((perspective.fov / 2) * (Math.PI / 180))) / height;
  }
  let later = 0;
  function render(what, pixels) {
    if (renderer.getPixelRatio() !== pixels) renderer.setPixelRatio(pixels);
    if (camera === perspective) {
      // The nearest plane as far away as it can be: depth is then fine enough for faces two centimetres apart.
      perspective.near = walking || !orbit ? 0.05 : Math.max(0.05, perspective.position.distanceTo(orbit.target) / 50);
      perspective.updateProjectionMatrix();
    }
    for (const detail of what.details) detail.mesh.visible = pixel_m(detail.mesh) < detail.size_m;
    what.scene.add(selection);
    renderer.render(what.scene, camera);
  }
  // Without a graphics card smooth edges cost as much as three more pictures: they are left to pictures that stand.
  const whole = { scene: scene, details: details };
  function drawStanding() {
    render(whole, window.devicePixelRatio * (software && triangles < 300000 ? 2 : 1));
  }
  function drawMoving() {
    if (!sketch) return render(whole, window.devicePixelRatio);
    for (const [layer, group] of Object.entries(sketch.layers)) group.visible = layers[layer].visible;
    render(sketch, window.devicePixelRatio);
  }
  function draw() {
    if (!renderer) return;
    drawMoving();
    clearTimeout(later);
    if (software) later = setTimeout(drawStanding, 150);
  }
  function redrawShadows() {
    if (renderer) renderer.shadowMap.needsUpdate = true;
    draw();
  }
  function resize() {
    if (!renderer) return;
    const width = $('view').clientWidth, height = $('view').clientHeight;
    renderer.setSize(width, height);
    perspective.aspect = width / height;
    perspective.updateProjectionMatrix();
    const half = Math.max(extent.z / 2, (extent.x / 2) * (height / width)) * 1.12;
    Object.assign(flat, { left: (-half * width) / height, right: (half * width) / height, top: half, bottom: -half });
    flat.updateProjectionMatrix();
    draw();
  }

  // ---- views ----
  function control(target) {
    if (orbit) orbit.dispose();
    orbit = null;
    if (!renderer || walking) return;
    orbit = new THREE.OrbitControls(camera, renderer.domElement);
    orbit.target.copy(target);
    orbit.enableRotate = camera === perspective;
    orbit.screenSpacePanning = true;
    if (camera === flat) orbit.mouseButtons = { LEFT: THREE.MOUSE.PAN, MIDDLE: THREE.MOUSE.DOLLY, RIGHT: THREE.MOUSE.PAN };
    orbit.addEventListener('change', draw);
    orbit.update();
  }
  /// As plans are drawn: the building, not its furniture, cut open above the upper storey's window sills, so that doors
  /// and windows show.
  function cut(open) {
    const height = Math.max(...floors.map((f) => f.about.elevation)) + 1.2;
    const plane = new THREE.Plane(new THREE.Vector3(0, -1, 0), height);
    for (const material of [...materials.values(), ...(sketch ? sketch.materials.values() : [])]) {
      material.clippingPlanes = open && !/^(furniture|seat)/.test(material.name) ? [plane] : null;
      material.side = open || /ceiling/.test(material.name) ? THREE.DoubleSide : THREE.FrontSide;
      material.needsUpdate = true;
    }
  }
  function show(layer, visible) {
    if (layers[layer]) layers[layer].visible = visible;
    const tick = document.querySelector('[data-layer=' + layer + ']');
    if (tick) tick.checked = visible;
  }
  function toScene(p, height) {
    return new THREE.Vector3(p[0] - origin.x, height, -(p[1] - origin.y));
  }
  function middleOf(outline) {
    let area = 0, x = 0, y = 0;
    outline.forEach((p, i) => {
      const q = outline[(i + 1) % outline.length], cross = p[0] * q[1] - q[0] * p[1];
      area += cross; x += (p[0] + q[0]) * cross; y += (p[1] + q[1]) * cross;
    });
    return [x / (3 * area), y / (3 * area)];
  }
  function stand(room) {
    const at = middleOf(room.about.outline), base = room.floor ? room.floor.about.elevation : 0;
    // In the corner farthest from the middle, looking across.
    const corner = room.about.outline.reduce((far, p) =>
      Math.hypot(p[0] - at[0], p[1] - at[1]) > Math.hypot(far[0] - at[0], far[1] - at[1]) + 1e-6 ? p : far);
    const from = [at[0] + (corner[0] - at[0]) * 0.86, at[1] + (corner[1] - at[1]) * 0.86];
    perspective.position.copy(toScene(from, base + 1.6));
    const toward = toScene([at[0] * 2 - from[0], at[1] * 2 - from[1]], base + 1.0).sub(perspective.position);
    yaw = Math.atan2(-toward.x, -toward.z);
    pitch = Math.atan2(toward.y, Math.hypot(toward.x, toward.z));
    look();
  }
  function look() {
    perspective.rotation.set(pitch, yaw, 0, 'YXZ');
    draw();
  }
  const hints = {
    orbit: 'drag: turn · right drag: move · wheel: nearer · click: what is this?',
    walk: 'W A S D or arrows: walk · drag: look around · click a room: its numbers',
    plan: 'drag: move · wheel: nearer · click a room: its numbers',
  };
  function setView(name) {
    document.querySelectorAll('#tools button').forEach((b) => b.classList.toggle('on', b.dataset.view === name));
    $('plan').style.display = name === 'drawing' ? 'block' : 'none';
    if (name === 'drawing') return;
    walking = name === 'inside';
    camera = name === 'plan' ? flat : perspective;
    show('ceilings', name === 'outside' || walking);
    light(walking ? 'room' : name === 'plan' ? 'plan' : 'open');
    ground.visible = !walking && name !== 'plan';
    selection.visible = !walking;
    cut(name === 'plan');
    perspective.fov = walking ? 75 : 50;
    $('hint').textContent = hints[walking ? 'walk' : name === 'plan' ? 'plan' : 'orbit'];
    const target = middle.clone();
    if (name === 'plan') {
      flat.position.copy(middle).setY(box.max.y + radius);
      flat.up.set(0, 0, -1);
      flat.lookAt(middle);
      target.y = 0;
    } else if (!walking) {
      const direction = name === 'outside' ? new THREE.Vector3(0.5, 0.42, 0.85) : new THREE.Vector3(0.12, 1, 0.62);
      perspective.position.copy(middle).add(direction.normalize().multiplyScalar(radius * 2.05));
      perspective.lookAt(middle);
    }
    resize();
    control(target);
    if (walking) stand(selected || rooms.find((r) => r.about.kind === 'room') || rooms[0]);
    redrawShadows();
  }

  // ---- numbers ----
  const metres = (x) => (x === undefined ? '' : x.toFixed(2) + ' m');
  const sigma = (x) => (x === undefined || x === 0 ? '' : ' ± ' + (100 * x).toFixed(1) + ' cm');
  const areaOf = (outline) => Math.abs(outline.reduce((sum, p, i) => {
    const q = outline[(i + 1) % outline.length];
    return sum + (p[0] * q[1] - q[0] * p[1]) / 2;
  }, 0));
  function element(tag, text, parent, css) {
    const added = document.createElement(tag);
    if (text !== undefined) added.textContent = text;
    if (css) added.className = css;
    parent.appendChild(added);
    return added;
  }
  function facts(thing) {
    const a = thing.about, list = [['Kind', a.kind], ['Type', a.type], ['Origin', a.origin]];
    if (a.kind === 'room') {
      list.push(['Width' + (a.origin === 'derived' ? ' (derived)' : ''), metres(a.width) + sigma(a.width_sigma)]);
      list.push(['Extracted width', a.extracted_width === undefined ? 'not scanned' : metres(a.extracted_width) + sigma(a.extracted_sigma)]);
      list.push(['Depth', metres(a.depth)]);
      list.push(['Type is certain to', (100 * a.type_probability).toFixed(0) + ' %']);
      if (a.rule) list.push(['Rule', (a.rule_path || [a.rule]).join(' › ')]);
      if (a.scans) list.push(['Scans', a.scans.join(', ')]);
    }
    if (a.outline && a.height) list.push(['Height', metres(a.height)], ['Area', areaOf(a.outline).toFixed(2) + ' m²']);
    if (a.kind === 'wall') list.push(['Between', (a.between || []).join(' and ')], ['Thickness', metres(a.thickness)], ['Length', metres(a.length)]);
    if (a.kind === 'door' || a.kind === 'window')
      list.push(['Room', a.room], ['Leads to', a.other], ['Width', metres(a.width)], ['Sill', metres(a.sill)], ['Head', metres(a.head)]);
    if (a.kind === 'furniture') list.push(['Room', a.room], ['Top', metres(a.top)]);
    return list.filter((f) => f[1] !== '' && f[1] !== undefined);
  }
  let selected = null;
  function select(thing) {
    selected = thing && thing.about.outline ? thing : selected;
    const panel = $('numbers');
    panel.textContent = '';
    while (selection.children.length) selection.remove(selection.children[0]);
    document.querySelectorAll('tbody tr').forEach((row) => row.classList.toggle('on', !!thing && row.dataset.node === thing.node));
    if (!thing) return draw();
    element('h2', thing.label + (thing.label === thing.about.id ? '' : ' (' + thing.about.id + ')'), panel);
    const list = element('dl', undefined, panel);
    for (const [name, value] of facts(thing)) {
      element('dt', name, list);
      element('dd', value, list);
    }
    const space = thing.floor && thing.about.space && (thing.floor.about.spaces || []).find((s) => s.id === thing.about.space);
    if (space && (space.alternatives || []).length) {
      element('h2', 'Other layouts of this space', panel);
      for (const other of space.alternatives)
        element('p', (100 * other.probability).toFixed(1) + ' %: ' + other.types.map((t, i) => t + ' ' + other.widths[i].toFixed(2)).join(', '), panel);
    }
    if (thing.about.outline && thing.floor && thing.about.kind !== 'floor') {
      const base = thing.floor.about.elevation, top = base + (thing.about.height || thing.about.top || 0);
      const area = new THREE.ShapeGeometry(new THREE.Shape(thing.about.outline.map((p) => new THREE.Vector2(p[0] - origin.x, p[1] - origin.y))));
      area.rotateX(-Math.PI / 2);
      const tint = new THREE.Mesh(area, new THREE.MeshBasicMaterial({ color: 0xd1495b, transparent: true, opacity: 0.3, depthWrite: false }));
      tint.position.y = thing.about.kind === 'furniture' ? top + 0.01 : base + 0.02;
      selection.add(tint);
      const loop = new THREE.BufferGeometry().setFromPoints(thing.about.outline.map((p) => toScene(p, top + 0.01)));
      selection.add(new THREE.LineLoop(loop, new THREE.LineBasicMaterial({ color: 0xd1495b })));
    }
    draw();
  }
  function fillSide() {
    element('h1', floors.map((f) => f.about.id).join(', ') || document.title, $('title'));
    const area = rooms.reduce((sum, r) => sum + areaOf(r.about.outline), 0);
    element('p', rooms.length + ' rooms and hallways, ' + area.toFixed(1) + ' m²; ◦ derived, nobody scanned it', $('title'));
    const body = $('rooms');
    for (const room of rooms) {
      const a = room.about, row = element('tr', undefined, body, a.origin);
      row.dataset.node = room.node;
      element('td', a.id, row);
      element('td', a.type, row);
      element('td', a.extracted_width === undefined ? '' : a.extracted_width.toFixed(2), row);
      element('td', a.kind === 'room' ? a.width.toFixed(2) : '', row);
      element('td', a.kind === 'room' && a.width_sigma ? (100 * a.width_sigma).toFixed(1) : '', row);
      element('td', areaOf(a.outline).toFixed(1), row);
      row.onclick = () => {
        select(room);
        if (walking) stand(room);
      };
    }
  }

  // ---- picking and walking ----
  function thingAt(x, y) {
    const rect = renderer.domElement.getBoundingClientRect(), ray = new THREE.Raycaster();
    ray.setFromCamera({ x: ((x - rect.left) / rect.width) * 2 - 1, y: 1 - ((y - rect.top) / rect.height) * 2 }, camera);
    const meshes = [];
    for (const group of Object.values(layers)) if (group.visible) meshes.push(...group.children);
    const hit = ray.intersectObjects(meshes)[0];
    if (!hit) return null;
    const parts = hit.object.userData.parts;
    let low = 0, high = parts.length - 1;
    while (low < high) {
      const half = (low + high + 1) >> 1;
      if (parts[half].first <= hit.faceIndex) low = half; else high = half - 1;
    }
    return parts[low].thing;
  }
  if (renderer) {
    const canvas = renderer.domElement, keys = new Set();
    let down = null;
    canvas.addEventListener('mousedown', (e) => { down = { x: e.clientX, y: e.clientY, lastX: e.clientX, lastY: e.clientY }; });
    window.addEventListener('mousemove', (e) => {
      if (!down || !walking) return;
      yaw += (e.clientX - down.lastX) * 0.004;
      pitch = Math.max(-1.4, Math.min(1.4, pitch + (e.clientY - down.lastY) * 0.004));
      down.lastX = e.clientX; down.lastY = e.clientY;
      look();
    });
    window.addEventListener('mouseup', (e) => {
      if (down && Math.hypot(e.clientX - down.x, e.clientY - down.y) < 4) select(thingAt(e.clientX, e.clientY));
      down = null;
    });
    const moves = { w: [0, -1], arrowup: [0, -1], s: [0, 1], arrowdown: [0, 1], a: [-1, 0], arrowleft: [-1, 0], d: [1, 0], arrowright: [1, 0] };
    let last = 0;
    function step(now) {
      if (!walking || !keys.size) { last = 0; return; }
      const seconds = last ? Math.min(0.1, (now - last) / 1000) : 0.016;
      last = now;
      for (const key of keys) {
        const [x, z] = moves[key], way = 1.8 * seconds;
        perspective.position.x += (x * Math.cos(yaw) + z * Math.sin(yaw)) * way;
        perspective.position.z += (z * Math.cos(yaw) - x * Math.sin(yaw)) * way;
      }
      draw();
      requestAnimationFrame(step);
    }
    window.addEventListener('keydown', (e) => {
      const key = e.key.toLowerCase();
      if (!moves[key] || !walking) return;
      e.preventDefault();
      if (!keys.size) requestAnimationFrame(step);
      keys.add(key);
    });
    window.addEventListener('keyup', (e) => keys.delete(e.key.toLowerCase()));
    window.addEventListener('blur', () => keys.clear());
  }
  document.querySelectorAll('#tools button').forEach((b) => { b.onclick = () => setView(b.dataset.view); });
  document.querySelectorAll('#tools input').forEach((tick) => {
    tick.onchange = () => { show(tick.dataset.layer, tick.checked); redrawShadows(); };
  });
  window.addEventListener('resize', resize);

  // ---- start: what the address asks for, e.g. #view=inside&room=203 ----
  fillSide();
  const wished = state.room && rooms.find((r) => r.about.id === state.room);
  if (wished) select(wished);
  setView(['outside', 'bird', 'plan', 'inside', 'drawing'].includes(state.view) ? state.view : 'bird');
  if (state.click && renderer) {  // a click for the tests: x,y as shares of the view
    const [x, y] = state.click.split(',').map(Number), rect = renderer.domElement.getBoundingClientRect();
    select(thingAt(rect.left + x * rect.width, rect.top + y * rect.height));
  }
  if (state.measure && renderer) {
    const pixel = new Uint8Array(4), gl = renderer.getContext(), opened = performance.now();
    const measure = (label, paint, times) => {
      const taken = [];
      for (let i = 0; i <= times; ++i) {  // the first makes shadows and shaders
        const start = performance.now();
        perspective.position.x += 0.01;
        paint();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits until the frame is drawn
        if (i) taken.push(performance.now() - start);
      }
      taken.sort((a, b) => a - b);
      const drawn = renderer.info.render;
      return label + ' ' + taken[times >> 1].toFixed(1) + ' ms a frame, ' + drawn.calls + ' draw calls, ' + drawn.triangles + ' triangles';
    };
    $('frame').textContent = [measure('moving', drawMoving, Math.max(20, Number(state.measure))), measure('standing', drawStanding, 2),
      triangles + ' triangles in all', 'opened in ' + (opened / 1000).toFixed(1) + ' s'].join('; ');
  }
  if (renderer) drawStanding();
  document.body.dataset.ready = renderer ? 'yes' : 'no3d';
})();
