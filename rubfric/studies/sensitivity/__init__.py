"""What friction depends on: by how much each number of rubber, road, block and load moves it."""
