// The robot of the soak: the demonstration with a module in Python that drives it for ever, its network, and all that a
// client can want; and another application that reads what it offers.

import { spawn } from 'node:child_process';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { RobotProcess } from './robot_process.mjs';

const kHere = dirname(fileURLToPath(import.meta.url));
const kChanges = [
  ['<load plugin="motion"/>', '<load plugin="motion"/>\n  <load plugin="python"/>'],
  ['<module name="world"', '<network reach="machine"><offer ports="world/pose robot/wheels"/></network>\n\n  <module name="world"'],
  [/<module name="referee"[^]*?<\/module>\n/, '<module name="wanderer" type="python/soak_wanderer.Wanderer"/>\n'],
  [/ referee\/(scene|pose|contact|goal)/g, ''],
  [/.*to="referee\/status".*\n/, ''],
  [/.*<on_fault of="\.".*\n/, ''],
  ['<port name="goal" direction="input"', '<port name="wish" direction="input" type="Twist2"/>\n    <port name="goal" direction="input"'],
  ['from="planner/twist" to="gate/wanted"', 'from="wish" to="gate/wanted"'],
  ['<connect from="laser/scan" to="robot/scan"/>', '<connect from="laser/scan" to="robot/scan wanderer/scan"/>\n  <connect from="wanderer/twist" to="robot/wish"/>'],
];

function Change(text, clock) {
  for (const [from, to] of [...kChanges, ['<clock type="simulated" speed="1"/>', clock]]) {
    const changed = text.replace(from, to);
    if (changed === text) throw new Error(`the demonstration has no '${from}' any more`);
    text = changed;
  }
  return text;
}

/** `clock`: its tag. */
export function SoakRobot({ clock, options = [], environment = {} }) {
  return RobotProcess.Begin({ change: (text) => Change(text, clock), options,
    environment: { RUNNEL_PYTHON_PATH: kHere, PYTHONPATH: process.env.RUNNEL_PYTHON ?? '', ...environment } });
}

/** Another application on this machine, which reads the robot's pose. */
export class Reader {
  constructor(robot) {
    this.robot = robot;
  }

  async start() {
    const { writeFile } = await import('node:fs/promises');
    const file = join(this.robot.folder, 'reader.xml');
    await writeFile(file, `<application name="reader" thread="control">
  <load plugin="simulation"/>
  <clock type="real"/>
  <thread name="control" period="50ms"/>
  <network reach="machine"/>
  <module name="localisation" type="simulation/localisation"/>
  <connect from="//bug_demo/world/pose" to="localisation/truth"/>
</application>
`);
    this.child = spawn(process.env.RUNNEL_PROGRAM, ['run', file, '--quiet'], { stdio: 'ignore', env: this.robot.environment });
    this.ended = new Promise((done) => { this.child.on('exit', done); });
  }

  async end() {
    this.child?.kill('SIGKILL');
    await this.ended;
  }
}
