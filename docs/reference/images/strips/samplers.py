STRIPS = {}
