# Copyright 2026 The amr_description authors
# SPDX-License-Identifier: Apache-2.0
"""The services of simulation_interfaces, asked of a simulator that began paused."""

import math

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Point, Pose, PoseStamped, Vector3
import pytest
from rcl_interfaces.msg import Log
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter
from ros_gz_interfaces.msg import Entity, EntityWrench
from simulation_interfaces.action import SimulateSteps
from simulation_interfaces.msg import (
    Bounds,
    EntityCategory,
    EntityFilters,
    EntityInfo,
    EntityState,
    Result,
    SimulationState,
    SimulatorFeatures,
    SpawnEntity as SpawnRequest,
    SpawnResult,
    TagsFilter,
)
from simulation_interfaces.srv import (
    DeleteEntity,
    GetAvailableWorlds,
    GetCurrentWorld,
    GetEntities,
    GetEntitiesStates,
    GetEntityBounds,
    GetEntityInfo,
    GetEntityState,
    GetNamedPoseBounds,
    GetNamedPoses,
    GetSimulationState,
    GetSimulatorFeatures,
    GetSpawnables,
    LoadWorld,
    ResetSimulation,
    SetEntityInfo,
    SetEntityState,
    SetSimulationState,
    SpawnEntities,
    SpawnEntity,
    StepSimulation,
    UnloadWorld,
)
from support.ros_processes import PATIENCE, running
from support.simulator import SIMULATOR, simulator, URDF
from visualization_msgs.msg import MarkerArray

from amr_description.clock import NANOSECONDS
from amr_description.ros.qos import LATCHED
from amr_description.ros.service_calls import call, wait_until

STEP = 2_000_000  # ns, of the physics
S = SimulationState
RESET = ResetSimulation.Request
BALL = """<robot name="ball"><link name="ball">
  <inertial><mass value="1"/><inertia ixx="0.004" iyy="0.004" izz="0.004" ixy="0" ixz="0" iyz="0"/>
  </inertial>
  <collision><geometry><sphere radius="0.1"/></geometry></collision></link></robot>"""


@pytest.fixture(scope='module')
def process():
    with simulator('paused:=true') as asked:
        asked.wait(lambda: asked.clock)
        yield asked


@pytest.fixture
def sim(process):
    """As at its start: paused at time 0, without robots."""
    yield process
    process.ask(SetSimulationState, state=S(state=S.STATE_PAUSED))
    process.do(ResetSimulation)
    # The next test waits for times that pass: those of this one must not be on their way.
    process.wait(lambda: process.clock and process.time == 0)


def state(sim):
    return sim.do(GetSimulationState).state.state


def turn(sim, target):
    sim.do(SetSimulationState, state=S(state=target))


def set_parameter(sim, name, value):
    request = SetParameters.Request(parameters=[Parameter(name, value=value).to_parameter_msg()])
    response = call(sim.node, SetParameters, f'{SIMULATOR}/set_parameters', request)
    return response.results[0]


def spawn_ball(sim, name='ball', z=1.0, **fields):
    request = SpawnEntity.Request(name=name, resource_string=BALL, **fields)
    request.initial_pose.pose.position.z = z
    pose = request.initial_pose
    return sim.do(SpawnEntity, name=name, resource_string=BALL, initial_pose=pose, **fields)


def height(sim, name='ball'):
    return sim.do(GetEntityState, entity=name).state.pose.position.z


def test_an_entity_goes_back_to_where_it_was_spawned(sim):
    spawn_ball(sim, 'other', z=3.0)
    spawn_ball(sim, z=2.0)
    turn(sim, S.STATE_PLAYING)
    sim.wait(lambda: height(sim) < 1.9)
    turn(sim, S.STATE_PAUSED)
    poses = {each.name: each for each in sim.do(GetNamedPoses).poses}
    assert set(poses) == {'other', 'ball'}
    assert list(poses['ball'].tags) == ['spawn']
    back = EntityState(pose=poses['ball'].pose)
    sim.do(SetEntityState, entity='ball', state=back)
    assert height(sim) == 2.0
    assert height(sim, 'other') < 3.0
    assert sim.do(GetNamedPoses, tags=TagsFilter(tags=['dock'])).poses == []


def test_a_link_is_pushed_by_topics(sim):
    def moved(steps):
        sim.do(StepSimulation, steps=steps)
        return sim.do(GetEntityState, entity='ball').state

    spawn_ball(sim, z=100.0)
    weight = EntityWrench(entity=Entity(name='ball::ball', type=Entity.LINK))
    weight.wrench.force.z = 9.81  # its mass is 1 kg
    wrench = sim.node.create_publisher(EntityWrench, f'{SIMULATOR}/wrench', 10)
    held = sim.node.create_publisher(EntityWrench, f'{SIMULATOR}/wrench/persistent', 10)
    clear = sim.node.create_publisher(Entity, f'{SIMULATOR}/wrench/clear', 10)
    for each in (wrench, held, clear):
        sim.wait(each.get_subscription_count)
    held.publish(weight)
    sim.wait(lambda: moved(1).acceleration.linear.z == pytest.approx(0.0, abs=1e-6))
    assert moved(100).acceleration.linear.z == pytest.approx(0.0, abs=1e-6)
    clear.publish(weight.entity)
    sim.wait(lambda: moved(1).acceleration.linear.z == pytest.approx(-9.81))
    push = EntityWrench(entity=Entity(name='ball', type=Entity.MODEL))
    push.wrench.force.x = 100.0
    wrench.publish(push)
    sim.wait(lambda: moved(1).twist.linear.x > 0.0)
    assert moved(10).twist.linear.x == pytest.approx(100.0 * STEP / NANOSECONDS)
    for each in (wrench, held, clear):
        sim.node.destroy_publisher(each)


@pytest.mark.parametrize(
    ('name', 'kind', 'force', 'text'),
    [
        ('nobody', Entity.MODEL, 1.0, "there is no robot 'nobody'; there are: ball"),
        ('ball::arm', Entity.LINK, 1.0, "there is no link 'arm'"),
        ('ball', Entity.LINK, 1.0, 'a link is named <robot>::<link>'),
        ('ball', Entity.JOINT, 1.0, 'entity of type 7; MODEL (2), <robot>, and LINK (3)'),
        ('ball', Entity.MODEL, math.nan, 'finite numbers are needed'),
        ('ball', Entity.MODEL, 1e308, 'finite numbers are needed, up to 100000'),
        ('ball', Entity.MODEL, -1.1e5, 'finite numbers are needed, up to 100000'),
    ],
)
def test_what_cannot_be_pushed_is_a_line_of_the_log(sim, name, kind, force, text):
    lines = []
    logs = sim.node.create_subscription(Log, '/rosout', lambda each: lines.append(each.msg), 50)
    spawn_ball(sim)
    push = EntityWrench(entity=Entity(name=name, type=kind))
    push.wrench.force.x = force
    wrench = sim.node.create_publisher(EntityWrench, f'{SIMULATOR}/wrench', 10)
    sim.wait(lambda: wrench.get_subscription_count() and logs.get_publisher_count())

    def said():
        wrench.publish(push)  # /rosout may be matched later than it is known
        return any(text in line for line in lines)

    wait_until(sim.node, lambda: said() or None, every=0.1, timeout=PATIENCE)
    assert any(text in line for line in lines), lines
    sim.node.destroy_publisher(wrench)
    sim.node.destroy_subscription(logs)


def test_another_world_is_loaded_without_entities_and_stopped(sim):
    spawn_ball(sim)
    worlds = {each.name: each for each in sim.do(GetAvailableWorlds).worlds}
    marks = []
    markers = sim.node.create_subscription(
        MarkerArray, f'{SIMULATOR}/world', lambda each: marks.append(each), LATCHED
    )
    sim.wait(lambda: marks)
    loaded = sim.do(LoadWorld, uri=worlds['walls'].world_resource.uri).world
    assert loaded.name == sim.do(GetCurrentWorld).world.name == 'walls'
    assert state(sim) == S.STATE_STOPPED
    assert sim.do(GetEntities).entities == []
    sim.wait(lambda: any(each.text == 'east' for each in marks[-1].markers))
    spawn_ball(sim, z=0.1)  # on the ground of the new world
    turn(sim, S.STATE_PAUSED)
    sim.do(StepSimulation, steps=200)
    assert height(sim) == pytest.approx(0.1, abs=0.01)
    sim.do(LoadWorld, uri=worlds['empty'].world_resource.uri)
    sim.wait(lambda: not any(each.text == 'east' for each in marks[-1].markers))
    sim.node.destroy_subscription(markers)


@pytest.mark.parametrize(
    ('fields', 'code', 'text'),
    [
        ({}, LoadWorld.Response.NO_RESOURCE, 'uri is empty'),
        ({'resource_string': '<mujoco/>'}, LoadWorld.Response.UNSUPPORTED_FORMAT, 'from a file'),
        ({'uri': 'nowhere.xml'}, LoadWorld.Response.RESOURCE_PARSE_ERROR, 'neither a file nor'),
    ],
)
def test_what_is_no_world_is_not_loaded_and_the_present_one_stays(sim, fields, code, text):
    spawn_ball(sim)
    found, reason = sim.refused(LoadWorld, **fields)
    assert (found, text in reason) == (code, True), reason
    assert sim.do(GetEntities).entities == ['ball']
    assert sim.do(GetCurrentWorld).world.name == 'empty'


def test_a_broken_world_is_not_loaded_either(sim, open_path):
    spawn_ball(sim)
    (open_path / 'broken.xml').write_text(
        '<mujoco><worldbody><geom type="potato"/></worldbody></mujoco>'
    )
    code, reason = sim.refused(LoadWorld, uri=(open_path / 'broken.xml').as_uri())
    assert (code, 'broken.xml' in reason) == (LoadWorld.Response.RESOURCE_PARSE_ERROR, True)
    assert sim.do(GetEntities).entities == ['ball']


# --- state and time ------------------------------------------------------------------------------


def test_the_features_are_those_that_are_served(sim):
    features = sim.ask(GetSimulatorFeatures).features
    f = SimulatorFeatures
    unsupported = {
        f.POSE_BOUNDS: GetNamedPoseBounds,
        f.WORLD_UNLOADING: UnloadWorld,
    }
    lacking = {*unsupported, f.ENTITY_BOUNDS_CONVEX, f.WORLD_RESOURCE_STRING, f.WORLD_TAGS}
    known = {*range(15), *range(20, 27), *range(31, 34), *range(40, 46), f.SPAWNING_ENTITIES}
    assert set(features.features) == known - lacking
    assert 'a step is 2 ms' in features.custom_info
    for service_type in unsupported.values():
        code, _ = sim.refused(service_type)
        assert code == Result.RESULT_FEATURE_UNSUPPORTED


def test_it_plays_pauses_stops_and_says_so(sim):
    request = SetSimulationState.Response
    assert state(sim) == S.STATE_PAUSED
    sim.wait(lambda: sim.clock)  # heard while time stands still
    turn(sim, S.STATE_PLAYING)
    assert state(sim) == S.STATE_PLAYING
    sim.wait(lambda: sim.time > 100_000_000)
    code, reason = sim.refused(SetSimulationState, state=S(state=S.STATE_PLAYING))
    assert (code, reason) == (request.ALREADY_IN_TARGET_STATE, 'the simulation is PLAYING already')
    spawn_ball(sim)
    turn(sim, S.STATE_STOPPED)
    assert state(sim) == S.STATE_STOPPED
    assert sim.do(GetEntities).entities == []
    sim.wait(lambda: sim.time == 0)
    turn(sim, S.STATE_PAUSED)
    assert state(sim) == S.STATE_PAUSED
    for target in (S.STATE_NO_WORLD, S.STATE_LOADING_WORLD, 77):
        code, reason = sim.refused(SetSimulationState, state=S(state=target))
        assert code == request.INCORRECT_TRANSITION
        assert f'state {target} is asked of a simulation that is PAUSED' in reason


@pytest.mark.parametrize('steps', [1, 2, 7, 100])
def test_a_step_is_a_step_of_the_physics_and_answered_when_it_is_made(sim, steps):
    spawn_ball(sim)
    before = sim.do(GetEntityState, entity='ball').state
    sim.do(StepSimulation, steps=steps)
    after = sim.do(GetEntityState, entity='ball').state
    assert after.header.stamp.nanosec - before.header.stamp.nanosec == steps * STEP
    assert after.twist.linear.z == pytest.approx(-9.81 * steps * STEP / 1e9)
    sim.wait(lambda: sim.time == steps * STEP)
    assert state(sim) == S.STATE_PAUSED


def test_one_step_unless_another_number_is_given(sim):
    assert StepSimulation.Request().steps == 1
    sim.do(StepSimulation, steps=0)
    sim.wait(lambda: sim.time == 0)


@pytest.mark.parametrize('target', [S.STATE_PLAYING, S.STATE_STOPPED])
def test_only_a_paused_simulation_is_stepped(sim, target):
    turn(sim, target)
    code, reason = sim.refused(StepSimulation, steps=1)
    assert code == Result.RESULT_INCORRECT_STATE
    assert 'steps are made while it is PAUSED' in reason


def test_steps_that_are_overtaken_are_told(sim):
    """An hour of physics, as fast as it goes; a reset comes between."""
    client = sim.node.create_client(StepSimulation, f'{SIMULATOR}/step_simulation')
    sim.wait(client.service_is_ready)
    answer = client.call_async(StepSimulation.Request(steps=1_800_000_000))
    sim.wait(lambda: sim.time > 20_000_000)
    code, reason = sim.refused(StepSimulation, steps=1)
    assert code == Result.RESULT_INCORRECT_STATE
    assert 'of another step are still to pass' in reason
    sim.do(ResetSimulation, scope=RESET.SCOPE_TIME)
    sim.wait(answer.done)
    result = answer.result().result
    assert result.result == Result.RESULT_OPERATION_FAILED
    assert 'of 1800000000 steps were not made' in result.error_message
    sim.node.destroy_client(client)


@pytest.fixture
def action(sim):
    client = sim.action(SimulateSteps)
    yield client
    client.destroy()


def test_the_action_is_canceled_and_otherwise_tells_of_every_step(sim, action):
    feedback = []
    endless = sim.goal(action, feedback, SimulateSteps.Goal(steps=10**9))
    sim.wait(lambda: feedback)  # from here on none is lost
    sim.wait(endless.cancel_goal_async().done)
    status, result = sim.end(endless)
    assert (status, result.result) == (
        GoalStatus.STATUS_CANCELED,
        Result.RESULT_OPERATION_FAILED,
    )
    assert 'of 1000000000 steps' in result.error_message
    sim.do(ResetSimulation)
    feedback = []
    handle = sim.goal(action, feedback, SimulateSteps.Goal(steps=8))
    sim.wait(lambda: len(feedback) == 8)  # a client that has the result hears no more of it
    status, result = sim.end(handle)
    assert (status, result.result) == (GoalStatus.STATUS_SUCCEEDED, Result.RESULT_OK)
    told = [(each.completed_steps, each.remaining_steps) for each in feedback]
    assert told == [(n, 8 - n) for n in range(1, 9)]
    sim.wait(lambda: sim.time == 8 * STEP)


def test_the_action_needs_a_pause(sim, action):
    turn(sim, S.STATE_PLAYING)
    status, result = sim.end(sim.goal(action, [], SimulateSteps.Goal(steps=1)))
    assert (status, result.result) == (
        GoalStatus.STATUS_ABORTED,
        Result.RESULT_INCORRECT_STATE,
    )


def test_the_real_time_factor_is_set_while_it_runs(sim):
    for value, reason in ((-1.0, 'must be at least 0'), (float('nan'), 'must be a finite number')):
        refusal = set_parameter(sim, 'real_time_factor', value)
        assert not refusal.successful
        assert reason in refusal.reason
    assert not set_parameter(sim, 'paused', True).successful
    assert set_parameter(sim, 'real_time_factor', 1e-9).successful
    turn(sim, S.STATE_PLAYING)
    # In such slow motion the next instant is years off; everything is served all the same.
    assert height_of_spawned(sim) == pytest.approx(1.0)
    now = sim.time
    assert set_parameter(sim, 'real_time_factor', 0.0).successful
    sim.wait(lambda: sim.time > now + 20_000_000_000)
    assert set_parameter(sim, 'real_time_factor', 1.0).successful


def height_of_spawned(sim):
    spawn_ball(sim)
    return height(sim)


# --- reset ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ('scope', 'time', 'fallen', 'there'),
    [
        (RESET.SCOPE_TIME, 0, True, True),
        (RESET.SCOPE_STATE, 100 * STEP, False, True),
        (RESET.SCOPE_TIME | RESET.SCOPE_STATE, 0, False, True),
        (RESET.SCOPE_SPAWNED, 100 * STEP, None, False),
        (RESET.SCOPE_SPAWNED | RESET.SCOPE_TIME, 0, None, False),
        (RESET.SCOPE_DEFAULT, 0, None, False),
        (RESET.SCOPE_ALL, 0, None, False),
    ],
)
def test_a_reset_is_as_wide_as_its_scope(sim, scope, time, fallen, there):
    spawn_ball(sim)
    sim.do(StepSimulation, steps=100)
    sim.do(ResetSimulation, scope=scope)
    assert (sim.do(GetEntities).entities == ['ball']) is there
    if there:
        assert (height(sim) < 0.9) is fallen
        stamp = sim.do(GetEntityState, entity='ball').state.header.stamp
        assert stamp.nanosec == time
    sim.wait(lambda: sim.time == time)


def test_after_a_reset_everything_happens_again_to_the_last_bit(sim):
    begin = SpawnEntity.Request().initial_pose
    begin.pose.position.z, begin.pose.orientation.x = 0.3, 0.1
    sim.do(SpawnEntity, name='amr', resource_string=URDF, initial_pose=begin)
    runs = []
    for _ in range(2):
        sim.do(StepSimulation, steps=300)
        runs.append(sim.do(GetEntityState, entity='amr').state)
        sim.do(ResetSimulation, scope=RESET.SCOPE_TIME | RESET.SCOPE_STATE)
    assert runs[0] == runs[1]
    assert sim.do(GetEntityState, entity='amr').state.pose.position.z == 0.3


def test_a_scope_that_nobody_knows_changes_nothing(sim):
    sim.do(StepSimulation, steps=10)
    code, reason = sim.refused(ResetSimulation, scope=9)
    assert code == Result.RESULT_FEATURE_UNSUPPORTED
    assert 'scope 9 is asked' in reason
    sim.wait(lambda: sim.time == 10 * STEP)


# --- entities ------------------------------------------------------------------------------------


def test_entities_are_found_by_name_category_tags_and_place(sim):
    spawn_ball(sim, 'ball_1', z=1.0)
    spawn_ball(sim, 'ball_2', z=5.0)
    sim.do(SpawnEntity, name='amr', resource_string=URDF)
    info = EntityInfo(description='a red one', tags=['red'])
    info.category.category = EntityCategory.CATEGORY_OBJECT
    sim.do(SetEntityInfo, entity='ball_2', info=info)
    assert sim.do(GetEntityInfo, entity='ball_2').info == info
    robot = EntityCategory(category=EntityCategory.CATEGORY_ROBOT)
    near = Bounds(type=Bounds.TYPE_SPHERE, points=[Vector3(z=1.2), Vector3(x=0.15)])
    for filters, expected in (
        ({}, ['ball_1', 'ball_2', 'amr']),
        ({'filter': '^ball_[[:digit:]]$'}, ['ball_1', 'ball_2']),
        ({'categories': [robot]}, ['amr']),
        ({'tags': TagsFilter(tags=['red'])}, ['ball_2']),
        ({'bounds': near}, ['ball_1']),
        ({'bounds': near, 'tags': TagsFilter(tags=['red'])}, []),
    ):
        filters = EntityFilters(**filters)
        assert sim.do(GetEntities, filters=filters).entities == expected
        states = sim.do(GetEntitiesStates, filters=filters)
        assert states.entities == expected
        assert [each.header.frame_id for each in states.states] == ['world'] * len(expected)
    code, reason = sim.refused(GetEntities, filters=EntityFilters(filter='('))
    assert (code, 'is no POSIX extended' in reason) == (Result.RESULT_OPERATION_FAILED, True)
    hull = EntityFilters(bounds=Bounds(type=Bounds.TYPE_CONVEX_HULL))
    assert sim.refused(GetEntities, filters=hull)[0] == Result.RESULT_FEATURE_UNSUPPORTED
    info.category.category = 99
    assert 'category 99' in sim.refused(SetEntityInfo, entity='amr', info=info)[1]


def test_an_entity_is_put_elsewhere_and_set_in_motion(sim):
    spawn_ball(sim)
    wanted = EntityState()
    wanted.pose.position.x, wanted.pose.position.z = 3.0, 8.0
    wanted.twist.linear.x, wanted.twist.angular.y = 2.0, 1.0
    sim.do(SetEntityState, entity='ball', state=wanted)
    sim.do(StepSimulation, steps=250)
    found = sim.do(GetEntityState, entity='ball').state
    assert found.pose.position.x == pytest.approx(4.0, abs=1e-6)
    assert found.pose.position.z == pytest.approx(8.0 - 9.81 / 8, abs=0.01)
    assert found.twist.angular.y == pytest.approx(1.0, abs=1e-6)
    assert found.acceleration.linear.z == pytest.approx(-9.81, abs=1e-6)
    box = sim.do(GetEntityBounds, entity='ball').bounds
    assert (box.type, box.points[0].x) == (Bounds.TYPE_BOX, pytest.approx(0.1))
    invalid = SetEntityState.Response.INVALID_POSE
    wanted.header.frame_id = 'odom'
    assert sim.refused(SetEntityState, entity='ball', state=wanted)[0] == invalid
    wanted.header.frame_id, wanted.pose.position.x = 'world', float('inf')
    assert sim.refused(SetEntityState, entity='ball', state=wanted)[0] == invalid
    wanted.pose.position.x, wanted.twist.linear.x = 0.0, float('nan')
    code, reason = sim.refused(SetEntityState, entity='ball', state=wanted)
    assert (code, 'the twist is' in reason) == (Result.RESULT_OPERATION_FAILED, True)


@pytest.mark.parametrize(
    'service_type',
    [DeleteEntity, GetEntityBounds, GetEntityInfo, GetEntityState, SetEntityInfo, SetEntityState],
)
def test_nobody_is_not_found(sim, service_type):
    code, reason = sim.refused(service_type, entity='nobody')
    assert (code, reason) == (
        Result.RESULT_NOT_FOUND, "there is no entity 'nobody'; there are: none"
    )  # fmt: skip


def test_several_are_spawned_and_one_that_fails_keeps_no_other_from_it(sim):
    requests = [SpawnRequest(name=name) for name in ('one', 'one', 'two', 'three')]
    for at, request in enumerate(requests):
        request.entity_resource.resource_string = BALL
        request.initial_pose.pose.position.z = 1.0 + at
    requests[3].entity_resource.uri = 'package://no_such_package/x.urdf'
    response = sim.ask(SpawnEntities, spawn_requests=requests)
    assert response.result.result == SpawnEntities.Response.ENTITIES_SPAWN_FAILED
    assert '2 of 4 entities were not spawned' in response.result.error_message
    codes = [each.result.result for each in response.results]
    ok = Result.RESULT_OK
    assert codes == [ok, SpawnResult.NAME_NOT_UNIQUE, ok, SpawnResult.NO_RESOURCE]
    assert [each.entity_name for each in response.results] == ['one', '', 'two', '']
    assert sim.do(GetEntities).entities == ['one', 'two']


def test_what_is_listed_can_be_spawned(sim):
    listed = {each.uri.rpartition('/')[2]: each for each in sim.do(GetSpawnables).spawnables}
    assert {*listed} == {'amr.urdf', 'amr_sensors.urdf.xacro'}
    amr = listed['amr.urdf']
    assert sim.do(SpawnEntity, uri=amr.uri).entity_name == amr.description == 'amr'
    away = PoseStamped(pose=Pose(position=Point(x=5.0)))
    for each in listed.values():
        name = f'{each.description}_too'
        sim.do(SpawnEntity, name=name, uri=each.uri, entity_namespace='/too', initial_pose=away)
        sim.do(DeleteEntity, entity=name)
    code, reason = sim.refused(GetSpawnables, sources=['/no/such/folder'])
    assert (code, "source '/no/such/folder'" in reason) == (Result.RESULT_NOT_FOUND, True)


def test_worlds_are_listed_and_the_present_one_is_among_them(sim, open_path):
    worlds = sim.do(GetAvailableWorlds).worlds
    assert sim.do(GetCurrentWorld).world in worlds
    (open_path / 'mine.xml').write_text('<mujoco/>')
    more = sim.do(GetAvailableWorlds, additional_sources=[str(open_path)]).worlds
    assert [world.name for world in more] == [*(world.name for world in worlds), 'mine']
    tagged = TagsFilter(tags=['indoor'])
    assert sim.do(GetAvailableWorlds, filter=tagged).worlds == []
    sources = ['/no/such/folder']
    assert sim.refused(GetAvailableWorlds, additional_sources=sources)[0] == (
        Result.RESULT_NOT_FOUND
    )
    found = sim.do(GetAvailableWorlds, additional_sources=sources, continue_on_error=True)
    assert found.worlds == worlds


# --- its end -------------------------------------------------------------------------------------


def test_it_quits_when_it_is_asked_to(sim):
    # Beside the first one, so with a clock of its own.
    options = ('--ros-args', '-r', '__node:=other', '-r', '/clock:=/other/clock')
    with running('mujoco_sim', *options, until='waiting') as process:
        request = SetSimulationState.Request(state=S(state=S.STATE_QUITTING))
        name = '/other/set_simulation_state'
        response = call(sim.node, SetSimulationState, name, request, timeout=PATIENCE)
        assert response.result.result == Result.RESULT_OK
        assert process.wait(PATIENCE) == 0
