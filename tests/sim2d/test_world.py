"""The world: it docks exactly, touches nothing, keeps the limits, and repeats itself to the bit."""

import math
import random
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from shapely import LineString, Polygon

from comity_executor import ActGoal
from comity_fis import InputError
from comity_sim2d import (
    DockingPose,
    Frames,
    Furniture,
    Person,
    RobotBody,
    Room,
    Scene,
    SceneError,
    Sensor,
    Wall,
    World,
    clearances_m,
    docked,
    speeds_m_s,
    write_frames_csv,
)
from tests.sim2d.tent import Tent

FEW = settings(max_examples=12, deadline=None)
LIMIT_S = 90.0


def random_scene(seed: int) -> Scene:
    """A furnished room with one to four people, everything where chance puts it.

    Raises:
        SceneError: Chance put something where it cannot stand.
    """
    rng = random.Random(seed)
    wide, high = rng.uniform(5.0, 8.0), rng.uniform(4.0, 7.0)
    furniture = tuple(
        Furniture.box(
            f"box {i}",
            rng.uniform(0.0, wide),
            rng.uniform(0.0, high),
            width_m=rng.uniform(0.3, 1.3),
            depth_m=rng.uniform(0.3, 1.0),
            angle_rad=rng.uniform(0.0, math.pi),
        )
        for i in range(rng.randint(0, 6))
    )
    walls = tuple(
        Wall((rng.uniform(0.0, wide), 0.0), (rng.uniform(0.0, wide), high / 2))
        for _ in range(rng.randint(0, 1))
    )
    people = tuple(
        Person(
            f"p{i}",
            rng.uniform(0.4, wide - 0.4),
            rng.uniform(0.4, high - 0.4),
            rng.uniform(-math.pi, math.pi),
        )
        for i in range(rng.randint(1, 4))
    )
    robot = RobotBody(rng.uniform(0.3, wide - 0.3), rng.uniform(0.3, high - 0.3), rng.uniform(-3.0, 3.0))
    return Scene(Room.rectangle(wide, high), robot, people, walls, furniture)


def is_possible(seed: int) -> bool:
    try:
        random_scene(seed)
    except SceneError:
        return False
    return True


SEEDS = st.integers(0, 100_000).filter(is_possible)


def visit(world: World, distance_m: float, bearing_deg: float, speed: float = 0.7) -> DockingPose | None:
    """Go to p0 and dock; None where there is no place to dock, or somebody stands in the only way."""
    pose = world.robot.choose_pose(
        "p0",
        distance_m=distance_m,
        bearing_deg=bearing_deg,
        distance_desirability=Tent(0.45, 1.2, distance_m),
        direction_desirability=Tent(0.0, 90.0, abs(bearing_deg)),
    )
    if pose is None:
        world.run(1.0)
        return None
    world.robot.navigate("p0", pose, speed_m_s=speed)
    if not arrives(world):
        return None
    world.robot.dock("p0", pose, speed_m_s=speed)
    world.step()
    return pose if arrives(world) else None


def arrives(world: World) -> bool:
    """Run until the robot is there; False where it stands before somebody in the way (test_in_the_way)."""
    world.step()
    while (motion := world.robot.motion()).state != "succeeded":
        assert world.time_s < LIMIT_S, motion
        if motion.blocked_by:
            world.run(1.0)
            return False
        assert not motion.is_blocked, motion
        world.step()
    return True


VISITS = (SEEDS, st.floats(0.45, 1.2), st.sampled_from([0.0, 0.0, 50.0, -50.0]))


@given(*VISITS)
@example(2233, 1.0, 0.0)  # it starts 8 cm beside somebody, and its way leads round them
@FEW
def test_the_robot_stops_where_it_should_and_faces_the_person(
    seed: int, distance: float, bearing: float
) -> None:
    world = World(random_scene(seed))
    pose = visit(world, distance, bearing)
    assume(pose is not None)
    stands = docked(world.robot.pose, world.scene.robot.radius_m, world.people[0])
    assert stands.distance_m == pytest.approx(pose.distance_m, abs=0.001)
    assert stands.bearing_deg == pytest.approx(pose.bearing_deg, abs=0.1)
    assert stands.facing_error_deg < 1.0


@given(*VISITS)
@example(698, 0.8, 0.0)  # it comes up to somebody in the only way, and waits there
@example(1142, 1.0, 0.0)  # the only way leads past somebody, to whom the robot comes up first
@FEW
def test_the_robot_touches_nothing(seed: int, distance: float, bearing: float) -> None:
    """Judged by geometry from the frames alone, and by the physics."""
    scene = random_scene(seed)
    world = World(scene)
    visit(world, distance, bearing)
    assert world.robot_touches == ()
    assert clearance_to_things(scene, world.frames) > 0.0
    starts_near = min(math.dist(scene.robot.pose.xy, p.pose.xy) - 0.45 for p in scene.people)
    assert clearances_m(world.frames).min() > min(0.30, starts_near) - 0.006


def clearance_to_things(scene: Scene, frames: Frames) -> float:
    way = LineString(frames.poses[:, 0, :2])
    gaps = [Polygon(scene.room.corners).exterior.distance(way)]
    gaps += [Polygon(piece.corners).distance(way) for piece in scene.furniture]
    gaps += [LineString([wall.start, wall.end]).distance(way) - wall.thickness_m / 2 for wall in scene.walls]
    return min(gaps) - scene.robot.radius_m


@given(*VISITS)
@example(14018, 1.0, 0.0)  # starts 4 cm from the person, and its way leads around them
@FEW
def test_speed_and_acceleration_stay_within_their_limits(seed: int, distance: float, bearing: float) -> None:
    world = World(random_scene(seed))
    visit(world, distance, bearing)
    frames = world.frames
    speed = speeds_m_s(frames)
    near = clearances_m(frames).min(axis=1) < 1.5
    assert speed.max() <= 0.7 + 1e-9
    assert speed[near[1:] | near[:-1]].max(initial=0.0) <= 0.5 + 1e-9
    velocity = np.diff(frames.poses[:, 0, :2], axis=0) * 20.0
    change = np.hypot(*np.diff(velocity, axis=0).T) * 20.0
    assert change.max() <= 0.5 + 1e-6


@given(SEEDS)
@settings(max_examples=4, deadline=None)
def test_the_same_seed_gives_the_same_bytes(seed: int) -> None:
    scene = random_scene(seed)
    noisy = Scene(
        scene.room,
        RobotBody(*scene.robot.pose.xy, sensor=Sensor(sigma_m=0.03, delay_s=0.1)),
        scene.people,
        scene.walls,
        scene.furniture,
    )
    records = []
    for _ in range(2):
        world = World(noisy, seed)
        world.robot.dock("p0", DockingPose(0.6, 0.0), speed_m_s=0.5)
        world.run(5.0)
        records.append(world.frames.poses.tobytes())
    assert records[0] == records[1]


def hall(**robot) -> Scene:
    return Scene(Room.rectangle(8.0, 6.0), RobotBody(0.8, 0.8, **robot), (Person("p0", 4.5, 3.2, math.pi),))


def test_the_reading_tells_distance_and_angles() -> None:
    world = World(hall())
    reading = world.robot.read("p0")
    assert reading is not None
    assert reading.centre_distance_m == pytest.approx(math.hypot(3.7, 2.4))
    assert reading.distance_m == pytest.approx(reading.centre_distance_m - 0.45)
    assert reading.bearing_deg == pytest.approx(math.degrees(math.atan2(2.4, 3.7)))  # to the person's left
    assert reading.facing_error_deg == pytest.approx(math.degrees(math.atan2(2.4, 3.7)))
    assert reading.speed_m_s == 0.0


def test_a_walking_person_is_followed_to_within_a_centimetre() -> None:
    world = World(hall())
    world.robot.dock("p0", DockingPose(0.64, 0.0), speed_m_s=0.5)
    assert arrives(world)
    errors = []
    for _ in range(120):
        person = world.people[0]
        world.move_person("p0", person.x_m, person.y_m + 0.01, person.heading_rad)  # 0.2 m/s
        world.step()
        errors.append(abs(docked(world.robot.pose, 0.25, world.people[0]).distance_m - 0.64))
    assert max(errors[40:]) < 0.01
    assert world.robot.motion().state == "succeeded"


def test_a_person_who_goes_elsewhere_is_docked_to_again() -> None:
    world = World(hall())
    world.robot.dock("p0", DockingPose(0.64, 0.0), speed_m_s=0.5)
    assert arrives(world)
    world.move_person("p0", 1.5, 4.5, 0.0)
    world.run(0.1)  # seen after one tick, acted upon after two
    assert world.robot.motion().state == "running"
    assert arrives(world)
    assert docked(world.robot.pose, 0.25, world.people[0]).distance_m == pytest.approx(0.64, abs=0.001)
    assert world.robot_touches == ()


def test_noise_and_delay_cost_centimetres_only() -> None:
    """3 cm of noise and 100 ms of delay: the 95th percentile of the error is below 3 cm."""
    errors = []
    for seed in range(20):
        world = World(hall(sensor=Sensor(sigma_m=0.03, delay_s=0.1)), seed)
        world.robot.dock("p0", DockingPose(0.64, 0.0), speed_m_s=0.7)
        assert arrives(world)
        errors.append(abs(docked(world.robot.pose, 0.25, world.people[0]).distance_m - 0.64))
    assert np.percentile(errors, 95) < 0.03


def test_nothing_is_seen_before_the_first_measurement_arrives() -> None:
    world = World(hall(sensor=Sensor(delay_s=0.2)))
    assert world.robot.read("p0") is None
    world.run(0.2)
    reading = world.robot.read("p0")
    assert reading is not None
    assert reading.stamp_s == pytest.approx(0.0)


def test_a_pose_that_no_route_leads_to_is_reported_as_blocked() -> None:
    wall = Wall((2.5, 0.0), (2.5, 6.0))
    scene = hall()
    world = World(Scene(scene.room, scene.robot, scene.people, (wall,)))
    world.robot.navigate("p0", DockingPose(0.64, 0.0), speed_m_s=0.5)
    world.step()
    assert world.robot.motion().is_blocked
    assert "no route" in world.robot.motion().text


def test_a_robot_that_does_not_get_on_says_so_after_three_seconds() -> None:
    """The person walks away faster than the robot can."""
    world = World(Scene(Room.rectangle(20.0, 4.0), RobotBody(0.8, 2.0), (Person("p0", 4.0, 2.0, math.pi),)))
    world.robot.dock("p0", DockingPose(0.64, 0.0), speed_m_s=0.7)
    blocked_at = None
    for tick in range(120):
        world.move_person("p0", 4.0 + 0.8 * 0.05 * tick, 2.0, math.pi)
        world.step()
        if blocked_at is None and world.robot.motion().is_blocked:
            blocked_at = world.time_s
    assert blocked_at is not None
    assert 3.0 < blocked_at < 4.5
    assert "no progress" in world.robot.motion().text


def test_a_robot_pushed_against_a_person_does_not_go_through() -> None:
    world = World(hall())
    world.robot.navigate("p0", DockingPose(0.64, 0.0), speed_m_s=0.5)
    world.run(4.0)
    x, y = world.robot.pose.xy
    world.move_person("p0", x + 0.30, y + 0.20, math.pi)
    world.run(1.0)
    assert [touch.entity for touch in world.robot_touches][:1] == ["p0"]
    assert clearances_m(world.frames)[-1].min() > -0.1


def test_facing_turns_on_the_spot() -> None:
    world = World(hall(heading_rad=math.pi))
    before = world.robot.pose
    world.robot.face("p0")
    assert arrives(world)
    reading = world.robot.read("p0")
    assert reading is not None
    assert reading.facing_error_deg < 1.0
    assert math.dist(before.xy, world.robot.pose.xy) < 1e-9


def test_stopping_brakes_within_the_limit_and_drops_the_command() -> None:
    world = World(hall())
    world.robot.navigate("p0", DockingPose(0.64, 0.0), speed_m_s=0.7)
    world.run(2.5)
    speed = speeds_m_s(world.frames)[-1]
    x = world.robot.pose.xy
    world.robot.stop()
    assert world.robot.motion().state == "stopped"
    world.run(3.0)
    assert math.dist(x, world.robot.pose.xy) == pytest.approx(speed**2 / (2 * 0.5), abs=0.06)
    assert speeds_m_s(world.frames)[-1] < 1e-9


def test_acts_take_their_time_and_can_be_broken_off() -> None:
    world = World(hall())
    robot = world.robot
    says = robot.perform(ActGoal("say", "p0", "x" * 50))
    nods = robot.perform(ActGoal("nod", "p0"))
    world.run(1.5)
    assert [robot.performance(act).state for act in (says, nods)] == ["running", "succeeded"]
    world.run(1.5)
    assert robot.performance(says).state == "succeeded"
    waves = robot.perform(ActGoal("wave", "p0"))
    world.run(0.5)
    robot.stop(waves)
    assert robot.performance(waves).state == "stopped"
    spoken, nod, wave = world.events
    assert (spoken.t_start, spoken.t_end) == (0.0, 3.0)
    assert (nod.t_end, nod.stopped) == (1.5, False)
    assert (wave.t_end, wave.stopped) == (3.5, True)


@pytest.mark.parametrize("call", ["read", "face"])
def test_a_stranger_is_an_error_that_names_the_nearest_name(call: str) -> None:
    with pytest.raises(ValueError, match="p0"):
        getattr(World(hall()).robot, call)("p1")


def test_frames_start_at_zero_and_the_csv_reads_back_to_the_bit(tmp_path) -> None:
    from comity_sim2d import read_frames_csv

    world = World(hall())
    world.robot.navigate("p0", DockingPose(0.64, 0.0), speed_m_s=0.5)
    world.run(1.0)
    write_frames_csv(tmp_path / "frames.csv", world.frames)
    text = (tmp_path / "frames.csv").read_text(encoding="utf-8")
    assert text.splitlines()[:2] == ["t,entity,x,y,heading_rad,radius_m", "0.0,robot,0.8,0.8,0.0,0.25"]
    back = read_frames_csv(tmp_path / "frames.csv")
    assert back.entities == ("robot", "p0")
    assert len(back) == 21
    assert back.poses.tobytes() == world.frames.poses.tobytes()
    assert back.time_s.tolist() == world.frames.time_s.tolist()


def test_frames_on_disk_can_be_read_wherever_writing_was_cut(tmp_path) -> None:
    """Written little by little they are the same bytes, and of a cut file all whole frames are read."""
    from comity_sim2d import FramesFile, read_frames_csv

    world = World(hall())
    world.run(0.3)
    write_frames_csv(tmp_path / "whole.csv", world.frames)
    with FramesFile(tmp_path / "growing.csv") as growing:
        for so_far in (2, 5, len(world.frames)):
            part = world.frames_since(growing.count)
            new = so_far - growing.count
            growing.keep(Frames(part.entities, part.radius_m, part.time_s[:new], part.poses[:new]))
    text = (tmp_path / "whole.csv").read_bytes()
    assert (tmp_path / "growing.csv").read_bytes() == text
    whole = read_frames_csv(tmp_path / "whole.csv")
    first_frame = sum(len(line) + 1 for line in text.split(b"\n")[:3])
    for cut in range(first_frame, len(text)):
        (tmp_path / "cut.csv").write_bytes(text[:cut])
        frames = read_frames_csv(tmp_path / "cut.csv")
        rows = text[:cut].count(b"\n") - 1
        assert len(frames) == rows // len(whole.entities)
        assert (frames.poses == whole.poses[: len(frames)]).all()


@given(st.integers(1, 20))
def test_frames_that_lack_a_row_are_refused_and_nobody_is_taken_for_another(missing: int) -> None:
    """Rows went by their number: of a file in which one is missing all later ones were somebody else's."""
    from comity_sim2d import read_frames_csv

    world = World(hall())
    world.run(0.5)
    with TemporaryDirectory() as folder:
        path = Path(folder, "frames.csv")
        write_frames_csv(path, world.frames)
        lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        path.write_text("".join(lines[:missing] + lines[missing + 1 :]), encoding="utf-8")
        with pytest.raises(InputError, match=f"line {missing + 1} of|line {missing + 2} of|line 3 of"):
            read_frames_csv(path)


def test_what_is_no_frames_is_written_nowhere(tmp_path) -> None:
    with pytest.raises(InputError, match="expected frames as a Frames, got None"):
        write_frames_csv(tmp_path / "frames.csv", None)
    assert not list(tmp_path.iterdir())


@pytest.mark.study
def test_two_hundred_random_starts_stop_within_half_a_millimetre() -> None:
    rng, errors = random.Random(0), []
    for _ in range(200):
        start = RobotBody(rng.uniform(0.3, 7.7), rng.uniform(0.3, 5.7), rng.uniform(-math.pi, math.pi))
        if math.dist(start.pose.xy, (4.5, 3.2)) < 0.46:
            continue
        world = World(
            Scene(Room.rectangle(8.0, 6.0), start, (Person("p0", 4.5, 3.2, rng.uniform(-3.1, 3.1)),))
        )
        distance = rng.uniform(0.3, 1.2)
        world.robot.dock("p0", DockingPose(distance, rng.uniform(-90.0, 90.0)), speed_m_s=0.7)
        assert arrives(world)
        errors.append(abs(docked(world.robot.pose, 0.25, world.people[0]).distance_m - distance))
    assert len(errors) > 190
    assert max(errors) < 0.0005
