"""A second simulated rig, built apart from the product's own: other shapes, other rendering, other noise, other files.

It meets the product only through recordings and the command line, so a mistake that the
product and its own simulator share cannot hide here.
"""
