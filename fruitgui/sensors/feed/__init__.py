"""Connected sensors running: a thread each, their newest frames, their health, and queues of what they give."""

from fruitgui.sensors.feed.feed import Feed
from fruitgui.sensors.feed.health import LOST_SHARE, SLOW_SHARE, Running, SensorHealth
from fruitgui.sensors.feed.lit import Lit
from fruitgui.sensors.feed.order import ByArrival, ByCapture, Order
from fruitgui.sensors.feed.subscription import Arrival, DropOldest, Room, Subscription, WaitForRoom

__all__ = [
    "LOST_SHARE",
    "SLOW_SHARE",
    "Arrival",
    "ByArrival",
    "ByCapture",
    "DropOldest",
    "Feed",
    "Lit",
    "Order",
    "Room",
    "Running",
    "SensorHealth",
    "Subscription",
    "WaitForRoom",
]
