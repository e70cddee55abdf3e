"""One frame in, the fruit that one sensor saw in it out."""

from fruitgui.perception.features import FEATURE_NAMES as FEATURE_NAMES
from fruitgui.perception.paper import PAPER_FEATURE_NAMES as PAPER_FEATURE_NAMES
from fruitgui.perception.perceiver import Perceiver as Perceiver
from fruitgui.perception.settings import PerceptionSettings as PerceptionSettings
