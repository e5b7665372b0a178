// Copyright 2026 The amr_description authors
// SPDX-License-Identifier: Apache-2.0
// Written by web/protocol.py from protocol.py, introspection.py, forms.py, marks.py, navigation.py, bags.py, requests.py, states.py, samples.py in
// amr_description/viewer/; change those and run it: python web/protocol.py

/**
 * The messages between the page and the node `viewer`, over one WebSocket at `/ws`.
 *
 * Text frames are JSON, one message each, with its `type`. Binary frames, from the node to the
 * page alone, are states and samples of sensors. Lengths are in m, angles in rad, times in s, frames
 * and axes as in REP 103 (x ahead, y left, z up), quaternions in the order x, y, z, w.
 *
 * Here are the messages to pages, and the heads of samples; those from pages are in `requests.py`,
 * the layout of states in `states.py`, that of samples in `samples.py`. These files define
 * the protocol, and `web/protocol.py` writes the page's side from them, with the documentation:
 * docstrings, and for a field the comment that begins with `#:`, beside it or above it.
 */

export type Quaternion = [number, number, number, number];

export type Vector = [number, number, number];

/** The WebSocket's subprotocol: a page of another version is refused. */
export const PROTOCOL = 'amr.v1';

/** The first message of every connection. */
export interface Hello {
  type: 'hello';
  /** the name of this page, as the others see it: "page 3" */
  client: string;
  /** of the package */
  version: string;
  /** ROS_DOMAIN_ID */
  domain: number;
  /** states per second, at most */
  rate: number;
  /** s after the last `drive` until the node stops the robot by itself */
  drive_timeout: number;
}

/** The topic of velocity commands. */
export interface Command {
  topic: string;
  /** its type: "geometry_msgs/msg/TwistStamped" or "geometry_msgs/msg/Twist" */
  message: string;
}

/** A robot in a simulator's world. */
export interface EntityInfo {
  simulator: string;
  /** that `delete` takes */
  name: string;
}

/** A robot, and its topics and nodes in the ROS graph; null: there is none. */
export interface RobotInfo {
  /** its namespace, "/" or "/robot1": the name of the robot in every other message */
  id: string;
  /** of the URDF */
  name: string;
  /** false: only described; the simulator has no such robot, as it was deleted, or never spawned */
  present: boolean;
  command: Command | null;
  /** the topic of odometry */
  odometry: string | null;
  /** the topic of ground truth */
  truth: string | null;
  /** the topic of wheel states */
  wheels: string | null;
  /** the topic of joint states */
  joint_states: string | null;
  /** the joint_state_publisher that takes positions, so that there are sliders */
  joint_publisher: string | null;
  /** the controller manager */
  manager: string | null;
  /** what it is in a simulator's world; null: in none, or nobody can tell */
  entity: EntityInfo | null;
}

/** A simulator. */
export interface SimulatorInfo {
  /** the node: "/mujoco_sim" */
  id: string;
  /** what is in its world, by the names that `delete` takes */
  entities: string[];
  /** the name of the present world; empty: it is not told */
  world: string;
  /** the names of those that `load_world` takes */
  worlds: string[];
}

/** How a topic is shown: what a sensor measured, or what others draw. */
export type SensorKind =
  | 'scan' | 'cloud' | 'picture' | 'range' | 'contacts' | 'map' | 'path' | 'markers' | 'poses' | 'polygon' | 'point';

/**
 * A topic of a sensor, or of maps, paths and markers, which the page shows as it does sensors.
 *
 * Pictures that come raw and compressed are there once.
 */
export interface SensorInfo {
  topic: string;
  /** whose namespace holds the topic; empty: a map, path or marker in none of theirs */
  robot: string;
  kind: SensorKind;
  /** its type: "sensor_msgs/msg/LaserScan" */
  message: string;
}

/** The robots, simulators and sensors of the ROS graph. Sent on every change. */
export interface Graph {
  type: 'graph';
  robots: RobotInfo[];
  simulators: SimulatorInfo[];
  /** what to do when there is nothing to see: "nothing publishes /robot_description; start …" */
  hint: string | null;
  sensors: SensorInfo[];
  navigators: Navigator[];
}

/** A joint with one position, rad or m. */
export interface JointInfo {
  name: string;
  kind: 'revolute' | 'continuous' | 'prismatic';
  /** -pi and pi of a continuous joint; finite */
  lower: number;
  upper: number;
  /** where Center puts it */
  zero: number;
  /** the joint that a mimic joint follows: it has no slider */
  follows: string | null;
}

/** A finding of check_urdf about the description. */
export interface Finding {
  level: 'error' | 'warning' | 'note';
  /** of its file, which for what xacro expanded is another than the URDF */
  line: number | null;
  /** the line of the URDF that this became */
  at: number | null;
  /** what is wrong */
  text: string;
  /** what would do; may be empty */
  remedy: string;
}

/** A robot's description. Sent when it was received, and when it has changed. */
export interface Model {
  type: 'model';
  robot: string;
  urdf: string;
  /** the link that is nobody's child */
  root: string;
  /** file name as in the URDF -> where the page fetches it: "/mesh/3f2a….stl" */
  meshes: Record<string, string>;
  /** all that move, in the order of the URDF */
  joints: JointInfo[];
  /** of check_urdf */
  findings: Finding[];
}

/** The static shapes of the world, in its frame `world`. Sent on every change. */
export interface World {
  type: 'world';
  simulator: string;
  shapes: Shape[];
}

/** A TF frame and its parent. */
export interface FrameInfo {
  name: string;
  parent: string;
}

/** The joints and wheels of a robot, in the order of the states. */
export interface RobotLayout {
  id: string;
  joints: string[];
  wheels: string[];
}

/** The order of the values in the states. Sent before the first state, and on every change. */
export interface Layout {
  type: 'layout';
  /** 0..65535; a state with another id is of an older layout and is dropped */
  id: number;
  /** the TF tree, parents before children; a root is no child */
  frames: FrameInfo[];
  robots: RobotLayout[];
}

/** State, time and real-time factors of a simulator; sent a few times per second. */
export interface SimulationStatus {
  type: 'simulation';
  simulator: string;
  state: 'playing' | 'paused' | 'stopped' | 'unknown';
  time: number;
  /** the real-time factor asked for; 0: as fast as possible */
  factor: number | null;
  /** the one that is, over the last second */
  real_factor: number | null;
}

/** Time has jumped back (a reset): trails and plots are cleared. */
export interface TimeReset {
  type: 'reset';
  time: number;
}

/** A controller. */
export interface ControllerInfo {
  name: string;
  kind: string;
  state: string;
  /** the command interfaces that it has claimed */
  claims: string[];
  /** the joints that `set_joints` can move by it */
  moves: string[];
}

/** A hardware component. */
export interface HardwareComponentInfo {
  name: string;
  kind: string;
  state: string;
}

/** The controllers and hardware components of a controller manager. */
export interface Controllers {
  type: 'controllers';
  robot: string;
  controllers: ControllerInfo[];
  hardware: HardwareComponentInfo[];
}

/** One status of /diagnostics. */
export interface DiagnosticItem {
  level: 'ok' | 'warn' | 'error' | 'stale';
  name: string;
  message: string;
}

/** The latest statuses of /diagnostics for a robot. */
export interface Diagnostics {
  type: 'diagnostics';
  robot: string;
  items: DiagnosticItem[];
}

/** The page that drives a robot; sent to every page on every change. */
export interface Driver {
  type: 'driver';
  robot: string;
  /** null: nobody */
  client: string | null;
  /** who drove until another page stopped the robot: it must let go */
  stopped: string | null;
}

/**
 * Who commands a robot besides the pages of this node, by its command topic.
 *
 * Sent to every page on every change.
 */
export interface Commanders {
  type: 'commanders';
  robot: string;
  /** that have a publisher there: "/planner" */
  nodes: string[];
  /** commands per second of all of them together, 0: none lately */
  rate: number;
}

/** A robot that is held at rest by `emergency_stop`. */
export interface HeldRobot {
  robot: string;
  /** the page that pressed STOP */
  client: string;
  /** when, s since 1970 */
  since: number;
  /**
   * 'holds': it stands, as measured or, where nothing measures it, by its lock; 'moves': it does
   * not, and does not brake; 'unknown': nothing measures it, and it has no lock
   */
  state: 'holds' | 'braking' | 'moves' | 'unknown';
  /** what drives it takes part in the lock, the topic `emergency_stop` */
  is_locked: boolean;
  /** active ones that drive it: deactivated, they cannot */
  controllers: string[];
  /** those that were deactivated for it; a release activates them */
  deactivated: string[];
}

/** The stops that are held, by any page. Sent to every page on every change. */
export interface EmergencyStop {
  type: 'emergency_stop';
  /** the page that stopped all robots; null: not all are stopped */
  client: string | null;
  /** when, s since 1970 */
  since: number | null;
  robots: HeldRobot[];
}

/** The age of the latest message of each kind, s of wall time; null: there was none. */
export interface RobotAges {
  robot: string;
  command: number | null;
  odometry: number | null;
  truth: number | null;
  joint_states: number | null;
}

/** How old is what the states say; sent a few times per second, whatever moves. */
export interface Ages {
  type: 'ages';
  /** of the latest /clock, s of wall time; null: nobody publishes it */
  clock: number | null;
  /** of the latest transform that moves */
  tf: number | null;
  robots: RobotAges[];
}

/** The reply to a request, by its `id`. */
export interface Reply {
  type: 'reply';
  id: number;
  ok: boolean;
  /** one line: what was done, or what was asked, found, and would do */
  message: string;
  /** what was asked for: the request says of what type */
  data: unknown;
  /** of a request that was done in part: the fields of the one that tries the rest again */
  again: Record<string, unknown> | null;
}

/** A line for the user: a robot has left the graph, a Twist without subscribers, and so on. */
export interface Notice {
  type: 'notice';
  level: 'info' | 'warning' | 'error';
  text: string;
}

/** How a topic is shown: as `topics`, `messages` or `fields` of Watch say. */
export type Channel = 'sensor' | 'message' | 'values';

/** Where a sample is from. */
export interface Origin {
  topic: string;
  /** of TF; of a robot with a TF of its own, without its namespace */
  frame: string;
  /** s */
  stamp: number;
  /** messages per second of the topic, those that were left out, too */
  rate: number | null;
}

/**
 * The head of a LaserScan, rad and m.
 *
 * f32 of the ranges follow; those that are none are not finite, or out of bounds.
 */
export interface Scan {
  type: 'scan';
  origin: Origin;
  angle_min: number;
  angle_increment: number;
  /** null: no bound */
  range_min: number | null;
  range_max: number | null;
  /** ranges of the message; fewer may follow, evenly thinned */
  count: number;
}

/**
 * The head of a PointCloud2.
 *
 * For each point x, y, z follow, f32, all points first; then their colours, three u8, if they
 * are 'rgb', or an f32, if they are 'intensity'.
 */
export interface Cloud {
  type: 'cloud';
  origin: Origin;
  /** points of the message; fewer may follow */
  count: number;
  colouring: 'rgb' | 'intensity' | 'none';
  /** the least intensity */
  low: number | null;
  high: number | null;
}

/** The head of a picture; its file follows. */
export interface Picture {
  type: 'picture';
  origin: Origin;
  format: 'image/jpeg' | 'image/png';
  /** of the message: rgb8, 32FC1 … */
  encoding: string;
  /** of the message; the file's may be smaller */
  width: number;
  height: number;
  /** of a picture of depths, m: the nearest is the lightest, black is none */
  low: number | null;
  high: number | null;
}

/**
 * The head of a Range, rad and m.
 *
 * An f32 follows: the distance; -inf: too near, inf: nothing there (REP 117).
 */
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
  /** places in which they do */
  points: number;
  /** N, on the first, of all of them together */
  force: number | null;
}

/** The head of contacts. For each place x, y, z (m), and the normal, follow, f32. */
export interface Contacts {
  type: 'contacts';
  origin: Origin;
  contacts: ContactInfo[];
}

/**
 * The head of a map or a costmap. Sent again when it has changed.
 *
 * The cells follow, i8, row by row from the origin, deflated (RFC 1950): 0 free to 100 occupied,
 * -1 not known.
 */
export interface OccupancyGrid {
  type: 'map';
  /** `stamp` is 0 */
  origin: Origin;
  /** cells in a row, along x */
  width: number;
  /** rows, along y */
  height: number;
  /** m, the side of a cell */
  resolution: number;
  /** of the outer corner of the first cell, m in `origin.frame` */
  position: Vector;
  orientation: Quaternion;
}

/** The head of a path. For each pose x, y, z (m, in `origin.frame`) follow, f32. */
export interface Route {
  type: 'path';
  origin: Origin;
  /** poses of the message; fewer may follow, evenly thinned */
  count: number;
  /** m */
  length: number;
}

/**
 * The head of what others draw: Marker, MarkerArray, PoseArray, PolygonStamped, PointStamped.
 *
 * All that there is, at each change. The numbers of each batch follow, one batch after the other.
 */
export interface Marks {
  type: 'marks';
  /** of the newest; `frame` of the first batch */
  origin: Origin;
  /** shapes, lines and points that there are; fewer may follow, evenly thinned */
  count: number;
  shown: number;
  batches: MarkBatch[];
  texts: MarkText[];
  /** why some are not drawn, or not as told, one line each */
  faults: string[];
}

/**
 * The head of the latest message of any topic, see `messages` of Watch.
 *
 * The message follows as JSON, an object by the names of the fields. What JSON cannot say, and
 * what is too long, is an object with keys that begin with #: {"#number": "NaN"}, or "Infinity",
 * "-Infinity", and integers beyond 2^53; {"#length": 360, "#first": [...]}, an array of that
 * many elements, of which these come first; {"#length": 5000, "#text": "..."}, a string of so
 * many bytes.
 */
export interface AnyMessage {
  type: 'message';
  /** `frame` and `stamp` are empty and 0 */
  origin: Origin;
  /** its type: "nav_msgs/msg/Odometry" */
  message: string;
  /** bytes */
  size: number;
}

/**
 * The head of numbers of messages of a topic: of all that came since the last sample.
 *
 * f64, aligned to 8 bytes, follow, column by column: the stamps of the `count` messages, s,
 * then the values of each path. A stamp is that of the header, if it is not 0, else
 * when the message was received, as states have their time. NaN: there is no such element, or
 * the path is one of `faults`. A page that is slow gets all samples later, up to a bound;
 * then the oldest are lost.
 */
export interface Values {
  type: 'values';
  /** `stamp`: of the last message */
  origin: Origin;
  /** those that any page plots */
  paths: string[];
  /** messages */
  count: number;
  /** the number of the first message: the one before ended before it, or messages were lost */
  first: number;
  /** path -> why there is no number, in one line */
  faults: Record<string, string>;
  /** path of a state -> value -> its name: a truth, a constant, or the text that it stands for */
  names: Record<string, Record<string, string>>;
}

/** In place of a sample: why the last message cannot be shown. */
export interface Unreadable {
  type: 'unreadable';
  origin: Origin;
  text: string;
  channel: Channel;
}

/** The head of a sample. */
export type Head =
  | Scan
  | Cloud
  | Picture
  | Distance
  | Contacts
  | OccupancyGrid
  | Route
  | Marks
  | AnyMessage
  | Values
  | Unreadable;

/** A text frame from the node. */
export type ServerMessage =
  | Hello
  | Graph
  | Model
  | World
  | Layout
  | SimulationStatus
  | TimeReset
  | Controllers
  | Diagnostics
  | Driver
  | Commanders
  | EmergencyStop
  | Ages
  | Reply
  | Notice
  | Topics
  | Services
  | GoalProgress
  | Transforms
  | Log
  | Findings
  | GoalStatus
  | Recording
  | Playhead
  | BagWriting;

/**
 * Messages to pages about the ROS graph itself, and what requests about it are answered: topics,
 * transforms, the log, parameters.
 */

/** A publisher of a topic, or a subscription. */
export interface Endpoint {
  /** "/robot1/controller_manager", or "?": not known */
  node: string;
  /** "reliable, volatile" */
  qos: string;
}

/** A topic of the ROS graph. */
export interface TopicInfo {
  name: string;
  /** types of its messages; usually one */
  kinds: string[];
  publishers: Endpoint[];
  subscriptions: Endpoint[];
  /** messages per second, of one publisher, while `rates` are watched */
  rate: number | null;
}

/** All nodes and topics, to pages that watch `topics`, and on every change. */
export interface Topics {
  type: 'topics';
  nodes: string[];
  topics: TopicInfo[];
}

/** A TF frame that is the child of another one. */
export interface FrameStatus {
  name: string;
  /** of the latest transform */
  parent: string;
  /** all that it had in the last seconds, and static ones: more than one is an error */
  parents: string[];
  is_static: boolean;
  /** transforms per second */
  rate: number | null;
  /** s since the last one came; of static ones null */
  age: number | null;
  /** by which it comes: "/tf", that of `parent` first */
  topics: string[];
}

/** The TF tree, to pages that watch `transforms`, each half a second. */
export interface Transforms {
  type: 'transforms';
  frames: FrameStatus[];
  /** nodes, by topic */
  publishers: Record<string, string[]>;
}

/** What `ros2 doctor` finds wrong in the graph. */
export interface FindingInfo {
  severity: 'error' | 'warning';
  /** its section in docs/api/doctor.md */
  rule: string;
  /** what was seen */
  what: string;
  /** why it matters */
  why: string;
  /** what mends it; commands are between back-quotes */
  fix: string;
}

/**
 * All findings: errors first, the causes before the rest.
 *
 * To pages that watch `findings`, and, looked for less often, to those that watch `alarms`.
 */
export interface Findings {
  type: 'findings';
  items: FindingInfo[];
}

/** A message of /rosout. */
export interface LogLine {
  /** one more for each that the node got */
  number: number;
  stamp: number;
  level: 'debug' | 'info' | 'warning' | 'error' | 'fatal';
  /** as it names itself: "robot1.controller_manager" */
  node: string;
  text: string;
  /** where in the source: "main (talker.py:23)" */
  place: string;
}

/** New lines of /rosout, to pages that watch `log`; at first the last warnings and errors. */
export interface Log {
  type: 'log';
  lines: LogLine[];
}

/** A parameter of a node: what it answers to `parameters`. */
export interface ParameterInfo {
  name: string;
  /** "bool", "integer", "double", "string", "byte_array", "bool_array" …, or "not set" */
  kind: string;
  value: unknown;
  read_only: boolean;
  description: string;
  constraints: string;
  /** of a number with a range */
  lower: number | null;
  upper: number | null;
  step: number | null;
}

/**
 * Messages about what pages send by forms: their fields, services that are called, goals of actions.
 *
 * What is published by forms is in `requests.py`.
 */

/** A field of what is sent: what `definition` is answered, for each field. */
export interface FieldInfo {
  name: string;
  /** "double", "string", or the type of a message: "geometry_msgs/msg/Vector3" */
  kind: string;
  /** of an array its length, 0 for any; null: it is none */
  length: number | null;
  /** of a message */
  fields: FieldInfo[];
  /** the default, of what is neither a message nor an array */
  value: unknown;
  /** by name, those of the message that may be its value */
  constants: Record<string, unknown>;
}

/** A service or an action that somebody serves. */
export interface CallInfo {
  name: string;
  /** its type: "std_srvs/srv/Trigger" */
  kind: string;
  is_action: boolean;
}

/** All services and actions, to pages that watch `services`, and on every change. */
export interface Services {
  type: 'services';
  services: CallInfo[];
}

/** How a goal goes that this page has sent by `send_goal`: to that page alone. */
export interface GoalProgress {
  type: 'goal_progress';
  /** the id of that request */
  goal: number;
  state: 'active' | 'succeeded' | 'canceled' | 'aborted' | 'lost';
  /** YAML: the latest feedback, at the end the result; of a lost one, why it is */
  text: string;
}

/** Call a service: the data of the reply are its response, in YAML. */
export interface CallService {
  type: 'call_service';
  id: number;
  service: string;
  /** its type: "std_srvs/srv/SetBool" */
  kind: string;
  /** as those of `publish` */
  values: Record<string, unknown>;
}

/**
 * Send a goal to an action; the reply tells that it is accepted, GoalProgress how it goes.
 *
 * It is cancelled when this page ends, and by STOP of the robot in whose namespace the action is;
 * while that stop holds it is refused.
 */
export interface SendGoal {
  type: 'send_goal';
  id: number;
  action: string;
  /** its type: "nav2_msgs/action/NavigateToPose" */
  kind: string;
  /** as those of `publish` */
  values: Record<string, unknown>;
}

/** Cancel a goal that this page has sent. */
export interface CancelSent {
  type: 'cancel_sent';
  id: number;
  /** the id of the request that sent it */
  goal: number;
}

/** What services and actions are asked. */
export type CallRequest = CallService | SendGoal | CancelSent;

/** What is drawn: the shapes of a world, and of what others draw the parts of a head. */

/** Red, green, blue, alpha in 0..1. */
export type Colour = [number, number, number, number];

/** A static shape of the world. */
export interface Shape {
  name: string;
  kind: 'box' | 'sphere' | 'cylinder' | 'capsule' | 'plane' | 'triangles';
  /** whole extents along x, y, z; a plane's are 0 where it has no end */
  size: Vector;
  position: Vector;
  orientation: Quaternion;
  colour: Colour;
  /** of 'triangles' only: x, y, z of three corners a triangle */
  points: number[];
}

/**
 * Marks of one kind in one frame, f32, m.
 *
 * Of shapes and meshes: x, y, z, quaternion, scale along x, y, z, r, g, b. Of lines: two ends,
 * then r, g, b of each. Of points and corners of triangles: x, y, z, r, g, b. Colours are sRGB.
 */
export interface MarkBatch {
  /** 'cone': of height 1 from its base up, diameter 1; all others about their middle */
  kind: 'box' | 'sphere' | 'cylinder' | 'cone' | 'mesh' | 'lines' | 'points' | 'triangles';
  /** of TF */
  frame: string;
  /** s, when it was where it is; null: it goes with its frame */
  stamp: number | null;
  /** of shapes, lines, points, corners */
  count: number;
  /** 0..1 */
  opacity: number;
  /** m, the width of lines and points; 0: two pixels */
  size: number;
  /** of a mesh: its name */
  resource: string;
  /** … where the page fetches it: "/mesh/3f2a….stl" */
  address: string;
  /** … whether its own colours do not count */
  is_tinted: boolean;
}

/** A text that faces the viewer. */
export interface MarkText {
  text: string;
  frame: string;
  stamp: number | null;
  position: Vector;
  /** m, of a letter */
  height: number;
  colour: Colour;
}

/**
 * Who drives robots to goals, and how a goal of a page goes; a part of `protocol.py`.
 *
 * Poses are seen from above: m and rad, in a frame of TF by the name that the states have it by.
 */

/** Who hears of a robot's goals and of its pose; null: nobody does. */
export interface Navigator {
  robot: string;
  /** the topic of goals, geometry_msgs/msg/PoseStamped */
  goal: string | null;
  /** the action nav2_msgs/action/NavigateToPose */
  action: string | null;
  /** the topic of poses, geometry_msgs/msg/PoseWithCovarianceStamped */
  initial_pose: string | null;
}

/** How the last goal that a page gave to a robot goes. Sent to every page on every change. */
export interface GoalStatus {
  type: 'goal';
  robot: string;
  /** the page that gave it */
  client: string;
  /**
   * 'published': by the topic, of which nothing is heard again; 'active': the action says how
   * far it is, and takes `cancel_goal`
   */
  state: 'published' | 'active' | 'reached' | 'cancelled' | 'failed';
  frame: string;
  x: number;
  y: number;
  yaw: number;
  /** why it was cancelled, or has failed */
  text: string;
  /** m to go, along the path; null: not told */
  distance: number | null;
  /** s to go, as estimated */
  time: number | null;
  /** times that it had to recover, as by spinning or backing up */
  recoveries: number;
}

/**
 * Messages about bags: one that the page shows in place of a ROS graph, and one that is recorded.
 *
 * What a bag holds is sent as a graph is: robots, states, samples. `time` of a state is that of the
 * last `/clock` of the bag, if it has one, else the time at which its messages were received.
 */

/** The bag that is shown. There is no graph: nothing can be driven, stopped or changed. */
export interface Recording {
  type: 'recording';
  /** of its folder or file */
  name: string;
  path: string;
  /** when it was begun, s since 1970, or of simulated time */
  begin: number;
  /** s */
  length: number;
  messages: number;
  /** bytes */
  size: number;
}

/** What time of the bag is shown, for all pages; sent while it changes. */
export interface Playhead {
  type: 'playhead';
  /** s since the bag's begin */
  place: number;
  playing: boolean;
  /** how many times faster than it was recorded */
  rate: number;
}

/** What the node records at a page's wish; it goes on when the page has gone. */
export interface BagWriting {
  type: 'bag_writing';
  active: boolean;
  /** the folder of the present bag, else of the last one; empty: there was none */
  path: string;
  seconds: number;
  messages: number;
  /** bytes of the messages */
  size: number;
  topics: number;
  /** messages for which there was no room */
  lost: number;
  /** why it has ended by itself; may be empty */
  error: string;
  /** where bags are made */
  folder: string;
  /** bytes that are free there */
  free: number;
}

/** Show another time of the bag. */
export interface Seek {
  type: 'seek';
  id: number;
  /** s since the bag's begin */
  place: number;
}

/** Play the bag from where it is, from its begin when it is at the end; or pause. */
export interface Playback {
  type: 'playback';
  id: number;
  playing: boolean;
  /** how many times faster than it was recorded; above 0, at most 100 */
  rate: number;
}

/** Ask for a number of all messages of a topic of the bag: SeriesData. */
export interface ReadSeries {
  type: 'series';
  id: number;
  topic: string;
  /** as `ros2 topic echo --field` has it */
  path: string;
}

/** Ask for states of the whole bag, evenly spaced: OverviewData. */
export interface ReadOverview {
  type: 'overview';
  id: number;
}

/** Have the node record topics into a new bag where it runs. */
export interface StartRecording {
  type: 'start_recording';
  id: number;
  /** none: all */
  topics: string[];
  /** types of messages that are left out */
  without_types: string[];
}

/** End what the node records. */
export interface StopRecording {
  type: 'stop_recording';
  id: number;
}

/**
 * What `series` is answered, in the order in which the messages were received.
 *
 * Of many messages, the least and the greatest value of those in a row stand for all.
 */
export interface SeriesData {
  /** f64, s, little-endian, in base64; of the header, else as states have their time */
  stamps: string;
  /** likewise; NaN: there is no such element */
  values: string;
  /** of the values of a state, as in Values */
  names: Record<string, string>;
}

/** What pages ask about bags. */
export type BagRequest =
  | Seek
  | Playback
  | ReadSeries
  | ReadOverview
  | StartRecording
  | StopRecording;

/**
 * The messages from pages, validated: a text frame is one of these, or refused in one line that says
 * what is wrong with it.
 */

/** Topics that a page may show of each kind: more are refused. */
export const MOST_TOPICS = 64;

/** Fields that a page may plot, of all topics together: more are refused. */
export const MOST_FIELDS = 256;

/**
 * What the node collects only while a page shows it: a part of the states (wheels), or a message of
 * the same name; `rates` are those of `topics`.
 */
export type Part =
  | 'wheels' | 'topics' | 'services' | 'rates' | 'transforms' | 'log' | 'findings' | 'alarms';

/**
 * Drive a robot, with the keyboard, the joystick or a gamepad, at most 60 times per second.
 *
 * The first message acquires the robot's lock, if no other page holds it; `stop` (or
 * drive_timeout without a `drive`) stops the robot and releases the lock. There is no reply,
 * as there is no `id`; a refusal is a notice.
 */
export interface Drive {
  type: 'drive';
  robot: string;
  /** m/s ahead; more than 100 either way is refused */
  linear: number;
  /** rad/s to the left, of the same bounds */
  angular: number;
  /** m/s to the left, of robots whose wheels can */
  sideways?: number;
}

/**
 * Stop a robot once, whichever page drives it: what a page sends when it lets go.
 *
 * Joints that pages have moved by controllers stay where they are.
 */
export interface Stop {
  type: 'stop';
  /** null: all robots */
  robot: string | null;
}

/**
 * STOP: hold a robot at rest until it is released, whoever commands it.
 *
 * It outlives this page. See the message `emergency_stop` for what becomes of it.
 */
export interface PressStop {
  type: 'press_stop';
  /** null: all robots, also those that come later */
  robot: string | null;
}

/**
 * Release a robot from `press_stop`, whichever page pressed it.
 *
 * Pages that drove it must let go before they can drive again.
 */
export interface Release {
  type: 'release';
  /** null: all robots */
  robot: string | null;
}

/**
 * Move joints: by joint_state_publisher where there is one, else by the active controllers whose
 * `moves` have them; a trajectory takes the time that the joints' limits of velocity ask for.
 */
export interface SetJoints {
  type: 'set_joints';
  robot: string;
  /** rad or m, by the names of the joints */
  positions: Record<string, number>;
}

/**
 * Push a link, as by a hand that holds it, at most 60 times per second.
 *
 * The last force acts until the next one, or none for 0.3 s; a page that has gone pushes nothing.
 * There is no reply; a refusal is a notice.
 */
export interface Push {
  type: 'push';
  simulator: string;
  /** by the name that `delete` takes */
  entity: string;
  link: string;
  /** N, in the axes of `world`, at the origin of the link; 0, 0, 0: let go */
  force: Vector;
  /** N m */
  torque: Vector;
}

/**
 * What this page shows from now on of what is collected on demand; nothing for a new connection.
 *
 * What no page shows is not known, NaN, in the states of all pages, and not subscribed: a
 * simulator need not work it out. There is no reply.
 */
export interface Watch {
  type: 'watch';
  /** of the states, beyond those that every state has; any other than those of Part is refused */
  parts: Part[];
  /** of SensorInfo; one that is not there may come later */
  topics?: string[];
  /** any topics, whose messages come whole (see AnyMessage), a few a second; likewise */
  messages?: string[];
  /**
   * by any topic, paths of numbers, as `ros2 topic echo --field` has them (`position[2]`),
   * which come of each message (see Values)
   */
  fields?: Record<string, string[]>;
  /** of topics, clouds of which all points come, less often */
  whole?: string[];
}

/** Run the simulation, or pause it. */
export interface Play {
  type: 'play' | 'pause';
  id: number;
  simulator: string;
}

/** Advance a paused simulation by physics steps. */
export interface Step {
  type: 'step';
  id: number;
  simulator: string;
  steps: number;
}

/** Reset the time to 0, and all robots to their initial poses. */
export interface ResetSimulation {
  type: 'reset_simulation';
  id: number;
  simulator: string;
}

/** Set the real-time factor. */
export interface SetFactor {
  type: 'set_factor';
  id: number;
  simulator: string;
  /** 0: as fast as possible */
  factor: number;
}

/** Spawn a robot. */
export interface Spawn {
  type: 'spawn';
  id: number;
  simulator: string;
  name: string;
  namespace: string;
  position: Vector;
  yaw: number;
  /** the robot whose description and active controllers it gets */
  like: string | null;
  /** its description, where it is like no other */
  urdf?: string | null;
  /** whether its root link is fixed to the world, as that of an arm */
  fixed?: boolean;
}

/**
 * Activate the controllers of a robot: those that are, or were, active of the one it is like.
 *
 * Of a robot that is not there any more nobody may know them; then all of the parameter file.
 */
export interface SetUp {
  type: 'set_up';
  id: number;
  robot: string;
  like: string;
}

/** Load another world; the robots are spawned again in it, with their active controllers. */
export interface LoadWorld {
  type: 'load_world';
  id: number;
  simulator: string;
  /** one of `worlds` */
  name: string;
}

/**
 * Put a robot elsewhere, upright and at rest.
 *
 * The data of the reply are true where the simulator warns, as of one that is inside something.
 */
export interface Place {
  type: 'place';
  id: number;
  simulator: string;
  name: string;
  /** of its root link, in `world` */
  position: Vector;
  yaw: number;
}

/** Put a robot back to where it was spawned, at rest; time goes on. */
export interface ResetEntity {
  type: 'reset_entity';
  id: number;
  simulator: string;
  name: string;
}

/** Delete a robot from the world. */
export interface Delete {
  type: 'delete';
  id: number;
  simulator: string;
  name: string;
}

/** Activate and deactivate controllers. */
export interface Switch {
  type: 'switch';
  id: number;
  robot: string;
  activate: string[];
  deactivate: string[];
}

/** Deactivate the controllers that drive a stopped robot, until it is released. */
export interface DeactivateDrive {
  type: 'deactivate_drive';
  id: number;
  robot: string;
}

/** Ask what a message, a request of a service or a goal has: FieldInfo of each field. */
export interface Definition {
  type: 'definition';
  id: number;
  /** the type of it, or of the service or action: "geometry_msgs/msg/Twist" */
  message: string;
}

/**
 * Publish a message, once or at a rate: until `unpublish`, or the end of this page.
 *
 * Another one of the same topic takes the place of the first. A velocity command is refused while
 * a stop holds.
 */
export interface Publish {
  type: 'publish';
  id: number;
  topic: string;
  /** its type */
  message: string;
  /** of the fields that are not their defaults; "now" is a time, "auto" a header */
  values: Record<string, unknown>;
  /** Hz; 0: once */
  rate?: number;
}

/** Publish no more what this page publishes at a rate. */
export interface Unpublish {
  type: 'unpublish';
  id: number;
  topic: string;
}

/** Ask for the parameters of a node: ParameterInfo of each. */
export interface ListParameters {
  type: 'parameters';
  id: number;
  node: string;
}

/** Set a parameter of a node. */
export interface SetParameter {
  type: 'set_parameter';
  id: number;
  node: string;
  name: string;
  /** as in ParameterInfo: the value is converted to it */
  kind: string;
  value: unknown;
}

/**
 * Have a robot navigate to a pose: by its action where there is one, else by its topic of goals.
 *
 * Refused while a stop holds the robot, which also cancels the goals that pages gave.
 */
export interface SetGoal {
  type: 'set_goal';
  id: number;
  robot: string;
  /** of TF, by the name that the states have it by */
  frame: string;
  /** m */
  x: number;
  y: number;
  /** rad */
  yaw: number;
}

/** Cancel the goal that a page, this or another one, gave to a robot. */
export interface CancelGoal {
  type: 'cancel_goal';
  id: number;
  robot: string;
}

/** Tell who localises a robot where it is, as RViz does: about 0.5 m and 15 degrees. */
export interface SetInitialPose {
  type: 'set_initial_pose';
  id: number;
  robot: string;
  /** of TF, by the name that the states have it by */
  frame: string;
  /** m */
  x: number;
  y: number;
  /** rad */
  yaw: number;
}

/** What `overview` is answered; the layout is that of its states, not of the one shown. */
export interface OverviewData {
  /** binary states one after the other, all of one length, in base64 */
  states: string;
  count: number;
  /** the id of their layout */
  layout: number;
  frames: FrameInfo[];
  robots: RobotLayout[];
}

/** What a simulator is asked. */
export type SimulatorRequest =
  | Play
  | Step
  | ResetSimulation
  | SetFactor
  | Spawn
  | LoadWorld
  | Place
  | ResetEntity
  | Delete;

/** Messages with an `id`, which get a reply. */
export type Request =
  | SimulatorRequest
  | SetUp
  | Switch
  | DeactivateDrive
  | Definition
  | Publish
  | Unpublish
  | ListParameters
  | SetParameter
  | SetGoal
  | CancelGoal
  | SetInitialPose
  | BagRequest
  | CallRequest;

/** A text frame from a page. */
export type ClientMessage = Drive | Stop | PressStop | Release | SetJoints | Push | Watch | Request;

/**
 * The binary frames of states, little-endian, filled in place. NaN: not known.
 *
 *      0  u8   1, the kind of the frame
 *      1  u8   0
 *      2  u16  id of the layout
 *      4  u32  number of the state, one more for each, so that gaps can be detected
 *      8  f64  time, s, of /clock if it is published, else of the system
 *     16  f32  …
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

export const STATE_KIND = 1;

export const POSE_FLOATS = 7;

export const JOINT_FLOATS = 3;

export const MOTION_FLOATS = 10;

export const COMMAND_FLOATS = 3;

export const WHEEL_FLOATS = 4;

/** Number of layout ids; they are reused after that. */
export const LAYOUTS = 65536;

/**
 * The binary frames of samples: what came by a topic, little-endian, for the pages that show it. A
 * page that is slow gets the newest of each topic, and of `values` all, up to a bound.
 *
 *     0  u8   2, the kind of the frame
 *     1  u8   0
 *     2  u16  bytes of the head: it ends at a multiple of 8 bytes
 *     4  …    the head: JSON, one of the types of `Head`, filled up with spaces
 *     …       what the head says
 */

export const SAMPLE_KIND = 2;

/** Bytes before the head of a sample. */
export const HEAD_AT = 4;

/** Of a place of contact: x y z (m), and the normal. */
export const PLACE_FLOATS = 6;

/** Points of a cloud that are sent. */
export const MOST_POINTS = 20000;

/** … of one of `Watch.whole`. */
export const WHOLE_POINTS = 1000000;
