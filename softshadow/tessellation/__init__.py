"""Polygons with holes and crossings, divided into triangles by the sweep of SGI's GLU (`softshadow.gl.tessellator`)."""
