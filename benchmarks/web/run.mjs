// WebAssembly and JavaScript engines in one run in node, one after another, one thread: `./dev bench web`.
// node run.mjs CAROM, where CAROM is the program that `./dev build wasm web` makes.

import { execFileSync } from 'node:child_process';
import Box2DFactory from 'box2d3-wasm';
import RAPIER from '@dimforge/rapier2d-simd-compat';
import * as planck from 'planck';
import Matter from 'matter-js';
import { dt, measure, scenes } from './scenes.mjs';

/** What is not measured without statics, for nothing is put down in it as it stands, is measured with them. */
function carom(program, without = false) {
  const rows = execFileSync(process.execPath, [program]).toString().trim().split('\n').map((line) => JSON.parse(line));
  const of = (name) => rows.find((row) => row.scene === name);
  return ({ name }) => (without && of(`${name} without statics`)) || of(name);
}

async function box2d() {
  const b2 = await Box2DFactory();
  return ({ walls, bodies, steps }) => {
    const worldDef = b2.b2DefaultWorldDef();
    worldDef.gravity = new b2.b2Vec2(0, -10);
    worldDef.enableSleep = false;
    const world = b2.b2CreateWorld(worldDef);
    const shapeDef = b2.b2DefaultShapeDef();
    shapeDef.density = 1;
    shapeDef.material.friction = 0.5;
    const ground = b2.b2CreateBody(world, b2.b2DefaultBodyDef());
    for (const [ax, ay, bx, by] of walls) {
      const segment = new b2.b2Segment();
      segment.point1 = new b2.b2Vec2(ax, ay);
      segment.point2 = new b2.b2Vec2(bx, by);
      b2.b2CreateSegmentShape(ground, shapeDef, segment);
    }
    const all = bodies.map((body) => {
      const def = b2.b2DefaultBodyDef();
      def.type = b2.b2BodyType.b2_dynamicBody;
      def.position = new b2.b2Vec2(body.x, body.y);
      const id = b2.b2CreateBody(world, def);
      if (body.box) {
        b2.b2CreatePolygonShape(id, shapeDef, b2.b2MakeBox(body.box, body.box));
      } else {
        const circle = new b2.b2Circle();
        circle.center = new b2.b2Vec2(0, 0);
        circle.radius = body.disc;
        b2.b2CreateCircleShape(id, shapeDef, circle);
      }
      return id;
    });
    const top = () => Math.max(...all.map((id) => b2.b2Body_GetPosition(id).y));
    return measure(() => b2.b2World_Step(world, dt, 4), top, steps);
  };
}

async function rapier() {
  await RAPIER.init();
  return ({ walls, bodies, steps }) => {
    const world = new RAPIER.World({ x: 0, y: -10 });
    world.timestep = dt;
    for (const [ax, ay, bx, by] of walls)
      world.createCollider(RAPIER.ColliderDesc.segment({ x: ax, y: ay }, { x: bx, y: by }).setFriction(0.5));
    const all = bodies.map((body) => {
      const rigid = world.createRigidBody(
        RAPIER.RigidBodyDesc.dynamic().setTranslation(body.x, body.y).setCanSleep(false));
      const shape = body.box ? RAPIER.ColliderDesc.cuboid(body.box, body.box) : RAPIER.ColliderDesc.ball(body.disc);
      world.createCollider(shape.setFriction(0.5), rigid);
      return rigid;
    });
    return measure(() => world.step(), () => Math.max(...all.map((b) => b.translation().y)), steps);
  };
}

function planckEngine() {
  return ({ walls, bodies, steps }) => {
    const world = new planck.World({ gravity: { x: 0, y: -10 }, allowSleep: false });
    const ground = world.createBody();
    for (const [ax, ay, bx, by] of walls)
      ground.createFixture({ shape: new planck.Edge({ x: ax, y: ay }, { x: bx, y: by }), friction: 0.5 });
    const all = bodies.map((body) => {
      const rigid = world.createDynamicBody({ position: { x: body.x, y: body.y } });
      const shape = body.box ? new planck.Box(body.box, body.box) : new planck.Circle(body.disc);
      rigid.createFixture({ shape, density: 1, friction: 0.5 });
      return rigid;
    });
    return measure(() => world.step(dt, 8, 3), () => Math.max(...all.map((b) => b.getPosition().y)), steps);
  };
}

/// Its unit is a pixel, with y downwards: 40 of them make a metre.
function matter() {
  const px = 40;
  return ({ walls, bodies, steps }) => {
    const engine = Matter.Engine.create({ gravity: { x: 0, y: 1, scale: 10 * px * 1e-6 } });
    const still = { isStatic: true, friction: 0.5 };
    for (const [ax, ay, bx, by] of walls) {
      const thick = 2, flat = ay === by;  // it has no segments
      const x = (ax + bx) / 2 + (flat ? 0 : Math.sign(ax) * thick / 2), y = (ay + by) / 2 - (flat ? thick / 2 : 0);
      Matter.Composite.add(engine.world, Matter.Bodies.rectangle(
        x * px, -y * px, (flat ? bx - ax + 2 * thick : thick) * px, (flat ? thick : by - ay) * px, still));
    }
    const all = bodies.map(({ box, disc, x, y }) => box
      ? Matter.Bodies.rectangle(x * px, -y * px, 2 * box * px, 2 * box * px, { friction: 0.5 })
      : Matter.Bodies.circle(x * px, -y * px, disc * px, { friction: 0.5 }));
    Matter.Composite.add(engine.world, all);
    return measure(() => Matter.Engine.update(engine, 1000 * dt),
      () => Math.max(...all.map((b) => -b.position.y)) / px, steps);
  };
}

const engines = {
  'Carom': carom(process.argv[2]),
  'Carom without statics': carom(process.argv[2], true),
  'box2d3-wasm': await box2d(),
  'rapier2d-simd': await rapier(),
  'planck': planckEngine(),
  'matter-js': matter(),
};

console.log('| engine | pyramid of 210: median (mean) [ms], top [m] | rain of 2000: median (mean) [ms], top [m] |');
console.log('|---|---|---|');
for (const [name, run] of Object.entries(engines)) {
  const cells = Object.keys(scenes).map((scene) => {
    const { median, mean, top } = run({ name: scene, ...scenes[scene] });
    return `${median.toFixed(3)} (${mean.toFixed(3)}), ${top.toFixed(2)}`;
  });
  console.log(`| ${name} | ${cells.join(' | ')} |`);
}
process.exit(0);
