"""A 2D world in which a robot visits people and stops at the distance and on the side that suit them."""

from comity_sim2d.base.physics import Touch
from comity_sim2d.frames import Frames, FramesFile, read_frames_csv, write_frames_csv
from comity_sim2d.maps.doorways import DoorTurn
from comity_sim2d.maps.library import load_map, shipped_maps
from comity_sim2d.maps.place_map import PlaceMap
from comity_sim2d.metrics import (
    EPISODE,
    VISIT,
    Contacts,
    Known,
    Metric,
    Metrics,
    Span,
    Stopping,
    TargetStop,
    clearances_m,
    measure,
    of_episode,
    of_person,
    path_length_m,
    speeds_m_s,
    stopping,
)
from comity_sim2d.navigation.docking import Docked, DockingPose, docked, free_bearing, pose_blocker, spot_pose
from comity_sim2d.navigation.fetching import places, standing_place
from comity_sim2d.navigation.past_people import PastPeople
from comity_sim2d.navigation.pose_choice import Wish, choose_pose, side_name
from comity_sim2d.navigation.route import Route
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.people.said import Said
from comity_sim2d.pictures.animation import write_gif
from comity_sim2d.pictures.picture import draw_picture
from comity_sim2d.pictures.planned_route import PlannedRoute
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.pose import Pose, wrap_angle
from comity_sim2d.robot.acts import HAND_OVER, PICK_UP, ActEvent
from comity_sim2d.robot.carrying import carried_at, carryings
from comity_sim2d.robot.motion import MotionProgress, PersonEstimate
from comity_sim2d.robot.sim_robot import SimRobot
from comity_sim2d.scene.area import Area, Location
from comity_sim2d.scene.comfort import Comfort
from comity_sim2d.scene.door import Door
from comity_sim2d.scene.group import Group
from comity_sim2d.scene.o_space import OSpace, o_space
from comity_sim2d.scene.passers_by import PassersBy
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody, Sensor
from comity_sim2d.scene.robot_reaction import RobotReaction
from comity_sim2d.scene.room import Furniture, Room, Wall
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene.spawning import random_spot
from comity_sim2d.scene.walk import SPEED_M_S, Walk
from comity_sim2d.scene_error import SceneError
from comity_sim2d.world import World

__all__ = [
    "EPISODE",
    "HAND_OVER",
    "PICK_UP",
    "SPEED_M_S",
    "VISIT",
    "ActEvent",
    "Area",
    "Comfort",
    "Contacts",
    "Docked",
    "DockingPose",
    "Door",
    "DoorTurn",
    "Frames",
    "FramesFile",
    "Furniture",
    "Group",
    "Known",
    "Location",
    "Metric",
    "Metrics",
    "MotionProgress",
    "OSpace",
    "PassersBy",
    "PastPeople",
    "Person",
    "PersonEstimate",
    "PlaceMap",
    "PlannedRoute",
    "Pose",
    "Ring",
    "RobotBody",
    "RobotReaction",
    "Room",
    "Route",
    "RouteMap",
    "Said",
    "Scene",
    "SceneError",
    "Sensor",
    "SimRobot",
    "Span",
    "Stopping",
    "TargetStop",
    "Touch",
    "Walk",
    "Wall",
    "Wish",
    "World",
    "carried_at",
    "carryings",
    "choose_pose",
    "clearances_m",
    "docked",
    "draw_picture",
    "free_bearing",
    "load_map",
    "measure",
    "o_space",
    "of_episode",
    "of_person",
    "path_length_m",
    "places",
    "pose_blocker",
    "random_spot",
    "read_frames_csv",
    "shipped_maps",
    "side_name",
    "speeds_m_s",
    "spot_pose",
    "standing_place",
    "stopping",
    "wrap_angle",
    "write_frames_csv",
    "write_gif",
]
