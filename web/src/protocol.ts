// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
/**
 * The messages between the page and the node `viewer`, over one WebSocket at `/ws`.
 *
 * Text frames are JSON, one message each, with its `type`. Binary frames, from the node to the page
 * alone, are states and samples of sensors; see the end of this file. Lengths are in m, angles in rad, times in s,
 * frames and axes as in REP 103 (x ahead, y left, z up), quaternions in the order x, y, z, w.
 *
 * The node's side is in amr_description/viewer/protocol.py; a test compares the two.
 */

export const PROTOCOL = 'amr.v1'; // the WebSocket's subprotocol: a page of another version is refused

export type Vector = [number, number, number];
export type Quaternion = [number, number, number, number];
export type Colour = [number, number, number, number]; // r, g, b, a in 0..1

// ---- node -> page: text ------------------------------------------------------------------------

/** The first message of every connection. */
export interface Hello {
  type: 'hello';
  client: string; // the name of this page, as the others see it: "page 3"
  version: string; // of the package
  domain: number; // ROS_DOMAIN_ID
  rate: number; // states per second, at most
  drive_timeout: number; // s after the last `drive` until the node stops the robot by itself
}

/** The robots, simulators and sensors of the ROS graph. Sent on every change. */
export interface Graph {
  type: 'graph';
  robots: RobotInfo[];
  simulators: SimulatorInfo[];
  hint: string | null; // what to do when there is nothing to see: "nothing publishes /robot_description; start …"
  sensors: SensorInfo[];
}

/** A topic of a sensor. Pictures that come raw and compressed are there once. */
export interface SensorInfo {
  topic: string;
  robot: string; // whose namespace holds the topic
  kind: 'scan' | 'cloud' | 'picture' | 'range' | 'contacts';
  message: string; // its type: "sensor_msgs/msg/LaserScan"
}

export interface RobotInfo {
  id: string; // its namespace: "/" or "/robot1"; the name of the robot in every other message
  name: string; // of the URDF
  command: { topic: string; message: string } | null; // message: "geometry_msgs/msg/TwistStamped" or ".../Twist"
  odometry: string | null; // topics
  truth: string | null;
  wheels: string | null;
  joint_states: string | null;
  joint_publisher: string | null; // the joint_state_publisher that takes positions, so that there are sliders
  manager: string | null; // the controller manager
}

export interface SimulatorInfo {
  id: string; // the node: "/mujoco_sim"
  entities: string[]; // what is in its world, by the names that `delete` takes
}

/** A robot's description. Sent when it was received, and when it has changed. */
export interface Model {
  type: 'model';
  robot: string;
  urdf: string;
  root: string; // the link that is nobody's child
  meshes: Record<string, string>; // file name as in the URDF -> where the page fetches it: "/mesh/3f2a…stl"
  joints: JointInfo[]; // all that move, in the order of the URDF
  findings: Finding[]; // of check_urdf
}

export interface JointInfo {
  name: string;
  kind: 'revolute' | 'continuous' | 'prismatic';
  lower: number; // -pi and pi of a continuous joint
  upper: number;
  zero: number; // where Center puts it
  follows: string | null; // a mimic joint has no slider
}

export interface Finding {
  level: 'error' | 'warning' | 'note';
  line: number | null;
  text: string; // what is wrong
  remedy: string; // what would do; may be empty
}

/** The static shapes of the world, in the frame `world`. Sent when received, and when changed. */
export interface World {
  type: 'world';
  simulator: string;
  shapes: Shape[];
}

export interface Shape {
  name: string;
  kind: 'box' | 'sphere' | 'cylinder' | 'capsule' | 'plane' | 'triangles';
  size: Vector; // whole extents along x, y, z; a plane's are 0 where it has no end
  position: Vector;
  orientation: Quaternion;
  colour: Colour;
  points: number[]; // of 'triangles' only: x, y, z of three corners a triangle
}

/** The order of the values in the states. Sent before the first state, and on every change. */
export interface Layout {
  type: 'layout';
  id: number; // 0..65535; a state with another id is of an older layout and is dropped
  frames: { name: string; parent: string }[]; // the TF tree, parents before children; a root is no child
  robots: { id: string; joints: string[]; wheels: string[] }[];
}

/** State, time and real-time factors of a simulator; sent a few times per second. */
export interface SimulationStatus {
  type: 'simulation';
  simulator: string;
  state: 'playing' | 'paused' | 'stopped' | 'unknown';
  time: number;
  factor: number | null; // the real-time factor asked for; 0: as fast as possible
  real_factor: number | null; // the one that is, over the last second
}

/** Time has jumped back (a reset): trails and plots are cleared. */
export interface TimeReset {
  type: 'reset';
  time: number;
}

export interface Controllers {
  type: 'controllers';
  robot: string;
  // moves: the joints that `set_joints` can move by it
  controllers: { name: string; kind: string; state: string; claims: string[]; moves: string[] }[];
  hardware: { name: string; kind: string; state: string }[];
}

export interface Diagnostics {
  type: 'diagnostics';
  robot: string;
  items: { level: 'ok' | 'warn' | 'error' | 'stale'; name: string; message: string }[];
}

/** The page that drives a robot; sent to every page on every change. */
export interface Driver {
  type: 'driver';
  robot: string;
  client: string | null; // null: nobody
  stopped: string | null; // who drove until another page stopped the robot: it must let go
}

/** The reply to a request, by its `id`. */
export interface Reply {
  type: 'reply';
  id: number;
  ok: boolean;
  message: string; // one line: what was done, or what was asked, found, and would do
}

/** A line for the user: a robot has left the graph, a Twist without subscribers … */
export interface Notice {
  type: 'notice';
  level: 'info' | 'warning' | 'error';
  text: string;
}

export type ServerMessage =
  | Hello | Graph | Model | World | Layout | SimulationStatus | TimeReset | Controllers
  | Diagnostics | Driver | Reply | Notice;

// ---- page -> node: text ------------------------------------------------------------------------

/**
 * Drive a robot, with the keyboard, the joystick or a gamepad, at most 60 times per second. The
 * first message acquires the robot's lock, if no other page holds it; `stop` (or drive_timeout
 * without a `drive`) stops the robot and releases the lock. There is no reply, as there is no `id`;
 * a refusal is a notice.
 */
export interface Drive {
  type: 'drive';
  robot: string;
  linear: number; // m/s ahead; more than 100 either way is refused
  angular: number; // rad/s to the left, of the same bounds
  sideways?: number; // m/s to the left, of robots whose wheels can; 0 when left out
}

/**
 * Stop a robot, whichever page drives it. Null: all robots. Joints that pages have moved by
 * controllers stay where they are.
 */
export interface Stop {
  type: 'stop';
  robot: string | null;
}

/**
 * Move joints: by joint_state_publisher where there is one, else by the active controllers whose
 * `moves` have them; a trajectory takes the time that the joints' limits of velocity ask for.
 */
export interface SetJoints {
  type: 'set_joints';
  robot: string;
  positions: Record<string, number>;
}

/** A part of the states that the node collects only while a page shows it. */
export type Part = 'wheels';

/**
 * The parts, beyond those that every state has, and the topics of sensors that this page shows from
 * now on; none for a new connection. What no page shows is not known, NaN, in the states of all
 * pages, and not subscribed: a simulator need not work it out. There is no reply.
 */
export interface Watch {
  type: 'watch';
  parts: Part[]; // any other than those of Part is refused
  topics?: string[]; // of SensorInfo; one that is not there may come later
}

export type Request =
  | { type: 'play' | 'pause'; id: number; simulator: string }
  | { type: 'step'; id: number; simulator: string; steps: number }
  | { type: 'reset_simulation'; id: number; simulator: string } // all robots back to their starts, time to 0
  | { type: 'set_factor'; id: number; simulator: string; factor: number }
  | { type: 'spawn'; id: number; simulator: string; name: string; namespace: string;
      position: Vector; yaw: number; like: string } // the URDF of robot `like`
  | { type: 'delete'; id: number; simulator: string; name: string }
  | { type: 'switch'; id: number; robot: string; activate: string[]; deactivate: string[] };

export type ClientMessage = Drive | Stop | SetJoints | Watch | Request;

// ---- node -> page: binary ----------------------------------------------------------------------

/**
 * A state, little-endian. NaN: not known.
 *
 *     0  u8   1, the kind of the frame
 *     1  u8   0
 *     2  u16  id of the layout
 *     4  u32  number of the state, one more for each, so that gaps can be detected
 *     8  f64  time, s, of /clock if it is published, else of the system
 *    16  f32  …
 *
 * The f32 values are: for each frame of the layout its pose in its parent (x y z qx qy qz qw); then
 * for each robot of the layout
 *
 *     position of each joint, then the velocity of each,
 *     then the commanded velocity of each                        3 × joints
 *     odometry: x y z qx qy qz qw, linear x, angular z, linear y 10, in the frame of the message
 *     ground truth: the same                                     10, in `world`
 *     command: linear x, angular z, linear y                     3, the latest on the command topic
 *     wheels: contact, normal force, slip along, slip across     4 × wheels, see `Watch`
 */
export const HEADER_BYTES = 16;
export const POSE_FLOATS = 7;
export const JOINT_FLOATS = 3;
export const MOTION_FLOATS = 10;
export const COMMAND_FLOATS = 3;
export const WHEEL_FLOATS = 4;

// ---- node -> page: samples of sensors, binary ----------------------------------------------------

/**
 * What a sensor has measured, little-endian, for the pages that show its topic. A page that is slow
 * gets the newest of each topic.
 *
 *     0  u8   2, the kind of the frame
 *     1  u8   0
 *     2  u16  bytes of the head, a multiple of 4
 *     4  …    the head: JSON, one of the types below, filled up with spaces
 *     …       what the head says
 */
export const SAMPLE_KIND = 2;
export const HEAD_AT = 4;
export const PLACE_FLOATS = 6; // of a place of contact

/** Of every sample. */
export interface Origin {
  topic: string;
  frame: string; // of TF; of a robot with a TF of its own, without its namespace
  stamp: number; // s
  rate: number | null; // messages per second of the topic, those that were left out, too
}

/** f32 of the ranges, m, follow; those that are none are not finite, or out of bounds. */
export interface Scan {
  type: 'scan';
  origin: Origin;
  angle_min: number;
  angle_increment: number;
  range_min: number | null; // null: no bound
  range_max: number | null;
  count: number; // ranges of the message; fewer may follow, evenly thinned
}

/**
 * For each point x, y, z follow, f32, all points first; then their colours, three u8, if they are
 * 'rgb', or an f32, if they are 'intensity'.
 */
export interface Cloud {
  type: 'cloud';
  origin: Origin;
  count: number; // points of the message; fewer may follow
  colouring: 'rgb' | 'intensity' | 'none';
  low: number | null; // the least intensity
  high: number | null;
}

/** The file of a picture follows. */
export interface Picture {
  type: 'picture';
  origin: Origin;
  format: 'image/jpeg' | 'image/png';
  encoding: string; // of the message: rgb8, 32FC1 …
  width: number; // of the message; the file's may be smaller
  height: number;
  low: number | null; // of a picture of depths, m: the nearest is the lightest, black is none
  high: number | null;
}

/** An f32 follows: the distance, m; -inf: too near, inf: nothing there (REP 117). */
export interface Distance {
  type: 'range';
  origin: Origin;
  field_of_view: number | null;
  min_range: number | null;
  max_range: number | null;
}

/** Two shapes that touch. */
export interface ContactInfo {
  first: string;
  second: string;
  points: number; // places in which they do
  force: number | null; // N, of all of them together
}

/** For each place x, y, z, and the normal, follow, f32. */
export interface Contacts {
  type: 'contacts';
  origin: Origin;
  contacts: ContactInfo[];
}

/** In place of a sample: why the last message cannot be shown. */
export interface Unreadable {
  type: 'unreadable';
  origin: Origin;
  text: string;
}

export type Head = Scan | Cloud | Picture | Distance | Contacts | Unreadable;
