"""What kind a fruit is: samples, the network, its training and its honest evaluation."""
