"""What importers of other programs' configurations share: trees with lines, points, and a draft made of points."""
