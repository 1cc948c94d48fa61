// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Made by `npm run types` from schema/wire.schema.json. Change that file instead of this one.

/**
 * Of a hand, an object, a link or a session.
 */
export type Name = string;
/**
 * For people to read.
 */
export type Sentence = string;
/**
 * x, y, z in the object frame: a point [m] or a direction of length 1.
 */
export type Vec3 = [number, number, number];
/**
 * x, y, z [m], then the quaternion w, x, y, z of a rigid motion into the object frame. The quaternion's length is 1 within 1 %; the receiver normalises it.
 */
export type Pose = [number, number, number, number, number, number, number];
/**
 * One for each link of the hand, in the order of the hand's `links`.
 */
export type LinkPoses = [Pose, ...Pose[]];
export type Variable = "distance" | "theta" | "phi" | "amplitude" | "dof";
export type ClientMessage =
  Hello | PlanStart | PlanStop | OnlineStart | OnlineStop | Wrist | Targets | Command | SolutionGet;
export type ServerMessage =
  | Welcome
  | ErrorMessage
  | PlanStarted
  | PlanProgress
  | PlanMilestone
  | PlanResult
  | OnlineReady
  | OnlineStopped
  | View
  | Closed
  | SolutionReply;

/**
 * eigengrasp wire protocol, version 1. Messages of the WebSocket /ws, answers of /api, lines of a session log. docs/wire-protocol.md explains them. SI units; object frame.
 */
export interface Wire {}
export interface Contact {
  point: Vec3;
  normal: Vec3;
  /**
   * Coulomb coefficient: the half angle of the friction cone is atan(friction).
   */
  friction: number;
  /**
   * Of a soft finger [m]; 0: point contact.
   */
  torsion_length: number;
  link: Name;
  /**
   * Points of one touching region share it.
   */
  patch: number;
}
/**
 * A grasp with all that is drawn of it.
 */
export interface Grasp {
  form_closure: boolean;
  /**
   * Radius of the largest ball inside the wrench space [-].
   */
  epsilon: number;
  /**
   * Of the wrench space [-].
   */
  volume: number;
  /**
   * Of the pre-grasp; lower is better.
   */
  energy: number;
  /**
   * Deepest [m].
   */
  max_penetration: number;
  /**
   * From the pre-grasp (first) to the grasp (last), evenly in joint space.
   *
   * @minItems 2
   * @maxItems 33
   */
  closing: [LinkPoses, LinkPoses, ...LinkPoses[]];
  /**
   * @minItems 0
   * @maxItems 2000
   */
  contacts: Contact[];
}
export interface PlanOptions {
  /**
   * States to draw and evaluate.
   */
  iterations?: number;
  /**
   * Distinct pre-grasps to keep, close and rate.
   */
  grasps?: number;
  seed?: number;
  /**
   * Default: staged.
   */
  search?: "staged" | "paper";
  /**
   * Default: contact.
   */
  energy?: "contact" | "wrench";
  /**
   * Eigengrasps that are searched.
   */
  amplitudes?: number;
  /**
   * Coulomb coefficient of every contact, instead of the materials'.
   */
  friction?: number;
}
export interface OnlineOptions {
  seed?: number;
  amplitudes?: number;
  /**
   * [rad]
   */
  cone_half_angle?: number;
  /**
   * Farthest distance along the approach [m].
   */
  look_ahead?: number;
  /**
   * How far behind the wrist pre-grasps may lie [m].
   */
  step_back?: number;
  /**
   * Of a grasp that is offered.
   */
  epsilon_min?: number;
  /**
   * Distance from the offered pre-grasp at which the fingers begin to take its posture [m].
   */
  preshape_begins?: number;
  /**
   * Coulomb coefficient of every contact, instead of the materials'.
   */
  friction?: number;
}
export interface Target {
  variable: Variable;
  /**
   * Of an amplitude or a degree of freedom.
   */
  index?: number;
  /**
   * [m], [rad] or [-], as the variable says.
   */
  value: number;
  /**
   * 0: says nothing; 1: certain.
   */
  confidence?: number;
}
export interface Limits {
  message_bytes: number;
  messages_per_second: number;
  upload_bytes: number;
  uploads: number;
}
/**
 * [s]
 */
export interface PlanTimings {
  prepare: number;
  search: number;
  close: number;
  volume: number;
  total: number;
}
/**
 * States that were drawn, and what became of the pre-grasps that were kept and closed.
 */
export interface PlanCounts {
  states: number;
  legal: number;
  tested: number;
  form_closed: number;
  not_closed: number;
  no_contact: number;
  penetrating: number;
}
/**
 * A form-closure grasp as seen from where the wrist is now.
 */
export interface Solution {
  /**
   * Counts up in the order in which they were found.
   */
  id: number;
  epsilon: number;
  /**
   * From the wrist to its pre-grasp along the approach direction [m].
   */
  distance: number;
  /**
   * Between the approach directions, or the wrist's turn where larger [rad].
   */
  angle: number;
  /**
   * Sideways, off the approach line [m].
   */
  offset: number;
  /**
   * Since it was found [s].
   */
  age: number;
}
/**
 * The offered grasp, as ghosts.
 */
export interface Offer {
  id: number;
  pregrasp: LinkPoses;
  grasp: LinkPoses;
}
/**
 * The region that the first stage searches (Fig. 6 of the paper).
 */
export interface SearchCone {
  apex: Vec3;
  axis: Vec3;
  /**
   * [rad]
   */
  half_angle: number;
  /**
   * Least distance along the axis [m].
   */
  nearest: number;
  /**
   * [m]
   */
  farthest: number;
}
export interface Rates {
  postures_per_second: number;
  candidates_per_second: number;
  postures: number;
  candidates: number;
  form_closed: number;
  /**
   * From the last new approach to its first solution [s]; 0: none yet.
   */
  time_to_first_grasp: number;
}
export interface WristSample {
  time: number;
  pose: Pose;
}
/**
 * First message of a connection.
 */
export interface Hello {
  type: "hello";
  protocol: number;
  role: "app" | "tracker";
  /**
   * Where the server asks for one.
   */
  token?: string;
  session?: Name;
}
/**
 * Plans grasps; a plan of this connection that still runs is stopped first.
 */
export interface PlanStart {
  type: "plan.start";
  hand: Name;
  object: Name;
  /**
   * Makes the object this many times larger.
   */
  scale?: number;
  /**
   * Whether a table stands right below the object. Default: false.
   */
  table?: boolean;
  options?: PlanOptions;
}
/**
 * Ends the search; what was found until then comes as plan.result.
 */
export interface PlanStop {
  type: "plan.stop";
}
/**
 * Begins an online session; one of this connection that still runs is stopped first.
 */
export interface OnlineStart {
  type: "online.start";
  hand: Name;
  object: Name;
  /**
   * Makes the object this many times larger.
   */
  scale?: number;
  /**
   * Whether a table stands right below the object. Default: false.
   */
  table?: boolean;
  options?: OnlineOptions;
}
export interface OnlineStop {
  type: "online.stop";
}
/**
 * Where the operator holds the wrist.
 */
export interface Wrist {
  type: "wrist";
  /**
   * Of the sender's clock [s]; only differences and order count.
   */
  time: number;
  pose: Pose;
  session?: Name;
}
/**
 * Shared control; replaces all targets that were set before.
 */
export interface Targets {
  type: "targets";
  /**
   * @minItems 0
   * @maxItems 64
   */
  targets: Target[];
  session?: Name;
}
export interface Command {
  type: "command";
  command: "close" | "open" | "forget";
  session?: Name;
}
export interface SolutionGet {
  type: "solution.get";
  id: number;
}
/**
 * Answer to hello. A tracker has no session of its own.
 */
export interface Welcome {
  type: "welcome";
  program: string;
  version: string;
  protocol: number;
  role: "app" | "tracker";
  session?: Name;
  limits: Limits;
}
/**
 * The connection goes on unless the server closes it right after.
 */
export interface ErrorMessage {
  type: "error";
  code:
    "bad_message" | "too_large" | "too_fast" | "not_allowed" | "not_known" | "no_session" | "busy" | "failed";
  message: Sentence;
  /**
   * Type of the message that it answers.
   */
  of?: string;
}
export interface PlanStarted {
  type: "plan.started";
  id: Name;
  hand: Name;
  object: Name;
}
export interface PlanProgress {
  type: "plan.progress";
  id: Name;
  iterations: number;
  total: number;
  seconds: number;
  /**
   * Absent until a legal state is found.
   */
  best_energy?: number;
}
/**
 * A state that is better than all before it (Fig. 2 of the paper).
 */
export interface PlanMilestone {
  type: "plan.milestone";
  id: Name;
  iteration: number;
  energy: number;
  link_poses: LinkPoses;
}
export interface PlanResult {
  type: "plan.result";
  id: Name;
  status: "found" | "none_closed" | "nothing_legal";
  stopped_early: boolean;
  explanation: Sentence;
  /**
   * Form-closed ones first, by falling epsilon; grasp N of grasp-N.glb counts from 1.
   *
   * @minItems 0
   * @maxItems 100
   */
  grasps: Grasp[];
  counts: PlanCounts;
  timings: PlanTimings;
}
/**
 * The planner waits for the first wrist.
 */
export interface OnlineReady {
  type: "online.ready";
  session: Name;
  hand: Name;
  object: Name;
  /**
   * z of the table's top [m]; absent: no table.
   */
  table_height?: number;
  /**
   * Of preparation.
   */
  seconds: number;
}
export interface OnlineStopped {
  type: "online.stopped";
  session: Name;
}
/**
 * All that is to be shown at one moment; at once after a wrist pose, and up to 60 times a second.
 */
export interface View {
  type: "view";
  frame: number;
  /**
   * Since the planner began [s].
   */
  time: number;
  phase: "waiting" | "approach" | "holding";
  wrist?: WristSample;
  /**
   * The wrist as given would be inside something.
   */
  blocked: boolean;
  link_poses: LinkPoses;
  /**
   * 0: open, 1: the offered pre-grasp's posture.
   */
  preshape: number;
  offer?: Offer;
  /**
   * The offered one first.
   *
   * @minItems 0
   * @maxItems 64
   */
  solutions: Solution[];
  cone: SearchCone;
  rates: Rates;
  /**
   * Of the grasp that close would make now; negative: would not hold; absent: not known yet.
   */
  epsilon_now?: number;
  /**
   * From the arrival of the newest wrist that this view is the first to show to the sending of this view [ms]; absent where the wrist is not new.
   */
  server_ms?: number;
  message: Sentence;
}
/**
 * Answer to the command close, to the app of the session.
 */
export interface Closed {
  type: "closed";
  grasp?: Grasp;
  message: Sentence;
}
export interface SolutionReply {
  type: "solution";
  id: number;
  grasp?: Grasp;
}
/**
 * One line of a session log: what came in or went out, t seconds after the log began.
 */
export interface LogLine {
  t: number;
  in?: ClientMessage;
  out?: ServerMessage;
}
export interface Range {
  name: Name;
  min: number;
  max: number;
}
export interface Hand {
  name: Name;
  title: string;
  n_dof: number;
  n_links: number;
  eigengrasps: number;
  /**
   * In the order of every LinkPoses; nodes of model.glb have these names.
   *
   * @minItems 1
   * @maxItems 256
   */
  links: [Name, ...Name[]];
  rest: LinkPoses;
  approach_point: Vec3;
  approach_direction: Vec3;
  /**
   * Radius of the ball about the base that holds the open hand [m].
   */
  reach: number;
  /**
   * In the order of every posture [rad or m].
   *
   * @minItems 0
   * @maxItems 256
   */
  dofs: Range[];
  /**
   * Of its eigengrasps.
   *
   * @minItems 0
   * @maxItems 256
   */
  amplitudes: Range[];
  uploaded: boolean;
}
export interface Object {
  name: Name;
  title: string;
  triangles: number;
  size: Vec3;
  center: Vec3;
  uploaded: boolean;
}
/**
 * GET /api/status. Hands and objects are empty where a token is needed and was not given.
 */
export interface Status {
  program: string;
  version: string;
  protocol: number;
  token_required: boolean;
  /**
   * @minItems 0
   * @maxItems 256
   */
  hands: Hand[];
  /**
   * @minItems 0
   * @maxItems 4096
   */
  objects: Object[];
  default_hand?: Name;
  default_object?: Name;
  limits: Limits;
  /**
   * Whether sessions are logged; see /api/logs.
   */
  logs: boolean;
}
/**
 * POST /api/objects?name=NAME&units=UNITS, POST /api/hands?name=NAME
 */
export interface UploadReply {
  name: Name;
  /**
   * @minItems 0
   * @maxItems 16
   */
  warnings: Sentence[];
}
/**
 * Body of every HTTP answer whose code is 400 or more.
 */
export interface ErrorReply {
  error: Sentence;
}
/**
 * GET /api/logs
 */
export interface Logs {
  /**
   * @minItems 0
   * @maxItems 10000
   */
  logs: {
    name: Name;
    bytes: number;
  }[];
}
