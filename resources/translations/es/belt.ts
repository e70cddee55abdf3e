<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>Belt</name>
    <message>
        <source>{count} views of passing fruit</source>
        <translation>{count} vistas de fruta que pasa</translation>
    </message>
</context>
<context>
    <name>BeltPage</name>
    <message>
        <source>Save belt</source>
        <translation>Guardar cinta</translation>
    </message>
    <message>
        <source>Save region, motion and heights</source>
        <translation>Guardar zona, movimiento y alturas</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
    <message>
        <source>Take back the last change to the region</source>
        <translation>Deshacer el último cambio de la zona</translation>
    </message>
    <message>
        <source>No belt is known yet</source>
        <translation>Aún no se conoce la cinta</translation>
    </message>
    <message>
        <source>Calibrate first; then the belt that the sensors found is drawn here, and its region can be set.</source>
        <translation>Calibre primero; después se dibuja aquí la cinta que encontraron los sensores, y se puede ajustar su zona.</translation>
    </message>
    <message>
        <source>Region of the belt</source>
        <translation>Zona de la cinta</translation>
    </message>
    <message>
        <source>Drag a corner; or: Space next corner, arrows move it (Shift: far), Insert adds one, Del removes it</source>
        <translation>Arrastre una esquina; o bien: Espacio pasa a la siguiente, las flechas la mueven (Mayús: más lejos), Insert agrega una, Supr la quita</translation>
    </message>
    <message>
        <source>The tallest fruit must be taller than the shortest.</source>
        <translation>La fruta más alta debe ser más alta que la más baja.</translation>
    </message>
    <message>
        <source>The belt is set. Drag a corner to change it.</source>
        <translation>La cinta está ajustada. Arrastre una esquina para cambiarla.</translation>
    </message>
    <message>
        <source>Fruit must pass before the sensors now.</source>
        <translation>Ahora debe pasar fruta frente a los sensores.</translation>
    </message>
    <message>
        <source>No sensor runs: connect them to see the belt, and to measure how it moves.</source>
        <translation>Ningún sensor funciona: conéctelos para ver la cinta y para medir cómo se mueve.</translation>
    </message>
    <message>
        <source>Look whether the region still fits, then save it.</source>
        <translation>Mire si la región todavía calza y guárdela.</translation>
    </message>
    <message>
        <source>Drag the corners to where fruit may be, set how the belt moves, then save.</source>
        <translation>Arrastre las esquinas hasta donde puede haber fruta, indique cómo se mueve la cinta y guarde.</translation>
    </message>
    <message>
        <source>The belt is saved.</source>
        <translation>La cinta quedó guardada.</translation>
    </message>
</context>
<context>
    <name>MotionDesk</name>
    <message>
        <source>Measuring the belt</source>
        <translation>Midiendo la cinta</translation>
    </message>
    <message>
        <source>No fruit passed from which the speed could be told.</source>
        <translation>No pasó fruta con la que se pudiera saber la velocidad.</translation>
    </message>
    <message>
        <source>Let the belt run with single fruit on it, and measure again; or type the speed.</source>
        <translation>Haga avanzar la cinta con frutas separadas y mida de nuevo; o escriba la velocidad.</translation>
    </message>
</context>
<context>
    <name>SidePanel</name>
    <message>
        <source>How the belt moves</source>
        <translation>Cómo se mueve la cinta</translation>
    </message>
    <message>
        <source>How tall fruit are</source>
        <translation>Qué alto tiene la fruta</translation>
    </message>
    <message>
        <source>Measure from passing fruit</source>
        <translation>Medir con fruta que pasa</translation>
    </message>
    <message>
        <source>Let the belt run with fruit on it, and measure (Ctrl+M)</source>
        <translation>Hacer avanzar la cinta con fruta y medir (Ctrl+M)</translation>
    </message>
    <message>
        <source>The speed is always the same</source>
        <translation>La velocidad es siempre la misma</translation>
    </message>
    <message>
        <source>Otherwise every run measures it anew from its first fruit</source>
        <translation>Si no, cada corrida la mide de nuevo con su primera fruta</translation>
    </message>
    <message>
        <source>To the right</source>
        <translation>A la derecha</translation>
    </message>
    <message>
        <source>To the left</source>
        <translation>A la izquierda</translation>
    </message>
    <message>
        <source>Where the belt moves to, as seen from above</source>
        <translation>Hacia dónde se mueve la cinta, vista desde arriba</translation>
    </message>
    <message>
        <source>&amp;Speed</source>
        <translation>&amp;Velocidad</translation>
    </message>
    <message>
        <source>Tu&amp;rned</source>
        <translation>&amp;Giro</translation>
    </message>
    <message>
        <source>Sh&amp;ortest</source>
        <translation>Más &amp;baja</translation>
    </message>
    <message>
        <source>&amp;Tallest</source>
        <translation>Más &amp;alta</translation>
    </message>
    <message>
        <source>Less</source>
        <translation>Menos</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Más</translation>
    </message>
    <message>
        <source>Speed of the belt</source>
        <translation>Velocidad de la cinta</translation>
    </message>
    <message>
        <source>Angle between the belt&apos;s motion and the longer side of the region</source>
        <translation>Ángulo entre el movimiento de la cinta y el lado largo de la zona</translation>
    </message>
    <message>
        <source>Height above the belt of the lowest fruit that comes</source>
        <translation>Altura sobre la cinta de la fruta más baja que viene</translation>
    </message>
    <message>
        <source>Height above the belt of the highest fruit that comes</source>
        <translation>Altura sobre la cinta de la fruta más alta que viene</translation>
    </message>
    <message>
        <source>The tallest fruit must be taller than the shortest.</source>
        <translation>La fruta más alta debe ser más alta que la más baja.</translation>
    </message>
    <message>
        <source>Measured: {speed}</source>
        <translation>Medida: {speed}</translation>
    </message>
    <message>
        <source>As it is typed here.</source>
        <translation>Tal como está escrita aquí.</translation>
    </message>
    <message>
        <source>Every run measures it anew from its first fruit.</source>
        <translation>Cada corrida la mide de nuevo con su primera fruta.</translation>
    </message>
</context>
<context>
    <name>ToolRow</name>
    <message>
        <source>Through {sensor}</source>
        <translation>A través de {sensor}</translation>
    </message>
    <message>
        <source>From above</source>
        <translation>Desde arriba</translation>
    </message>
    <message>
        <source>Add a corner after the chosen one</source>
        <translation>Agregar una esquina después de la elegida</translation>
    </message>
    <message>
        <source>Remove the chosen corner</source>
        <translation>Quitar la esquina elegida</translation>
    </message>
    <message>
        <source>Go back to what is saved</source>
        <translation>Volver a lo guardado</translation>
    </message>
    <message>
        <source>{count} corners, {area}</source>
        <translation>{count} esquinas, {area}</translation>
    </message>
</context>
</TS>
